/*
 * Overlapping surfaces, a frame each: anisotropically filtered textures, GL_COMBINE environments on three units, and
 * polygon offset. Walls and floors extend out of the view. Recorded by test_families.py.
 */
#include "tests/trace/window.h"

static unsigned char colors[64 * 64 * 4];

/* Bind a texture with all its levels to a unit. */
static void texture(unsigned unit, int format, int width, int height, int wrap, int min_filter, float anisotropy)
{
	unsigned name;

	glActiveTexture(GL_TEXTURE0 + unit);
	glGenTextures(1, &name);
	glBindTexture(GL_TEXTURE_2D, name);
	glEnable(GL_TEXTURE_2D);
	glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, min_filter);
	glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
	glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors);
}

/* A square in the plane z = 0 with the same coordinates for all units, and another colour in each quarter. */
static void square(float times)
{
	glBegin(GL_QUADS);
	for (int k = 0; k < 4; k++) {
		float u = k == 1 || k == 2, v = k >= 2;

		glColor4f(0.3f + 0.6f * u, 0.9f - 0.5f * v, 0.5f + 0.4f * u * v, 0.4f + 0.5f * v);
		for (unsigned unit = 0; unit < 3; unit++)
			glMultiTexCoord2f(GL_TEXTURE0 + unit, times * u + 0.1f * (float)unit, times * v - 0.3f);
		glVertex2f(u, v);
	}
	glEnd();
}

/* Wall i of four around the viewer, partly behind them; `layer` moves it. */
static void wall(int i, float layer, float times)
{
	glLoadIdentity();
	glRotatef(90 * (float)i + 17, 0, 0, 1);
	glTranslatef(-1.5f, -1, 0.5f + layer);
	glRotatef(-80 - 3 * (float)i, 1, 0, 0);
	glScalef(3, 9, 1);
	square(times);
}

static void reset(void)
{
	for (unsigned unit = 3; unit-- > 0;) {
		glActiveTexture(GL_TEXTURE0 + unit);
		glDisable(GL_TEXTURE_2D);
		glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
	}
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.4, 0.4, -0.3, 0.3, 0.5, 40);
	glMatrixMode(GL_MODELVIEW);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_LEQUAL);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glDisable(GL_POLYGON_OFFSET_FILL);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/* Footprints of all shapes; power-of-two sizes and others; a lower layer shines through. */
static void anisotropic(void)
{
	static const int filters[4] = { GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR,
		                        GL_NEAREST_MIPMAP_NEAREST };
	static const int sizes[4][2] = { { 64, 64 }, { 16, 64 }, { 48, 20 }, { 33, 7 } };

	for (int layer = 0; layer < 2; layer++)
		for (int i = 0; i < 4; i++) {
			const int wrap = (i + layer) % 2 ? GL_REPEAT : GL_CLAMP_TO_EDGE;

			texture(0, layer ? GL_RGBA : GL_LUMINANCE, sizes[i][0], sizes[i][1], wrap, filters[(i + layer) % 4], layer ? 16 : 3);
			if (layer)
				glEnable(GL_BLEND);
			wall(i, layer ? 0.2f : 0, i % 2 ? 0.9f : 7);
			glDisable(GL_BLEND);
		}
}

/* Each function and operand, with sources from the same unit, from others, and from none. */
static void combined(void)
{
	static const int functions[8] = { GL_REPLACE,     GL_MODULATE, GL_ADD,      GL_ADD_SIGNED,
		                          GL_INTERPOLATE, GL_SUBTRACT, GL_DOT3_RGB, GL_DOT3_RGBA };
	static const int sources[6] = { GL_TEXTURE, GL_PREVIOUS, GL_PRIMARY_COLOR, GL_CONSTANT, GL_TEXTURE0, GL_TEXTURE2 };
	static const int operands[4] = { GL_SRC_COLOR, GL_ONE_MINUS_SRC_ALPHA, GL_ONE_MINUS_SRC_COLOR, GL_SRC_ALPHA };
	const float constant[4] = { 0.3f, 0.9f, 0.5f, 0.6f };

	for (unsigned unit = 0; unit < 3; unit++)
		texture(unit, unit == 1 ? GL_RGB : GL_RGBA, 64, 64 >> unit, GL_REPEAT, GL_LINEAR_MIPMAP_LINEAR, 1);
	for (int i = 0; i < 16; i++) {
		for (unsigned unit = 0; unit < 3; unit++) {
			glActiveTexture(GL_TEXTURE0 + unit);
			glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
			glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, constant);
			glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, functions[(i + (int)unit * 3) % 8]);
			glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_ALPHA, functions[(i + (int)unit) % 6]);
			glTexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, i % 5 == 4 ? 2 : 1);
			glTexEnvf(GL_TEXTURE_ENV, GL_ALPHA_SCALE, i % 7 == 3 ? 4 : 1);
			for (unsigned k = 0; k < 3; k++) {
				const unsigned pick = (unsigned)i + unit * 2 + k;

				glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB + k, sources[pick % 6]);
				glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_ALPHA + k, sources[(pick + 1) % 6]);
				glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND0_RGB + k, operands[(pick / 2) % 4]);
				glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND0_ALPHA + k, operands[pick % 2 ? 3 : 1]);
			}
		}
		if (i >= 4)
			glEnable(GL_BLEND);
		wall(i % 4, 0.1f * (float)(i / 4), 2.5f);
		glDisable(GL_BLEND);
	}
}

/* Coplanar layers that only their offsets separate. */
static void offset(void)
{
	static const float offsets[4][2] = { { 0, 0 }, { -1, -2 }, { 1.5f, 1 }, { -2, 3 } };

	for (int layer = 0; layer < 4; layer++)
		for (int i = 0; i < 4; i++) {
			texture(0, GL_RGB, 64, 32 >> layer, GL_REPEAT, GL_LINEAR_MIPMAP_LINEAR, layer == 1 ? 8 : 1);
			glEnable(GL_POLYGON_OFFSET_FILL);
			glPolygonOffset(offsets[layer][0], offsets[layer][1]);
			wall(i, 0, 1.3f + (float)layer);
		}
}

int main(void)
{
	static void (*const frames[])(void) = { anisotropic, combined, offset };

	for (unsigned i = 0; i < sizeof(colors); i++)
		colors[i] = (unsigned char)((i * 2654435761u) >> 23);
	open_window();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), reset);
	return 0;
}
