/*
 * Pixel rectangles and bitmaps (OpenGL 2.1 sec. 3.6, 3.7, 4.3.3): unpacking, transfer, zoom, and writing to the window.
 */
#include "panels.h"

#include <math.h>

enum { SIDE = 6 };
/* bytes: those of this panel; Mesa caches drawn pixels by address */
static unsigned char all_bytes[4 * 4 * SIDE * SIDE + PANELS], *bytes;

static void prepare(void)
{
	for (unsigned i = 0; i < sizeof(all_bytes); i++)
		all_bytes[i] = (unsigned char)(255.9f * noise(i));
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	bytes = all_bytes;
}

static void place(float x, float y)
{
	bytes = all_bytes + (bytes - all_bytes + 1) % PANELS;
	glRasterPos3f(x, y, 0);
	glPixelZoom(2, 2);
}

static void draw_rgba(int i)
{
	(void)i;
	place(-0.7f, -0.7f);
	glDrawPixels(SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
}

/* Each format with each integer type. */
static void format(int i)
{
	(void)i;
}

static void draw_format(int i)
{
	static const GLenum formats[11] = { GL_RED, GL_GREEN, GL_BLUE,      GL_ALPHA,           GL_RGB,     GL_RGBA,
		                            GL_BGR, GL_BGRA,  GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_ABGR_EXT };
	static const GLenum types[6] = { GL_UNSIGNED_BYTE, GL_BYTE, GL_UNSIGNED_SHORT, GL_SHORT, GL_UNSIGNED_INT, GL_INT };
	const int f = choose(&i, 11), t = choose(&i, 6);

	place(-0.7f, -0.7f);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glDrawPixels(3, 3, formats[f], types[t], bytes);
}

static void draw_packed(int i)
{
	static const GLenum types[12] = { GL_UNSIGNED_BYTE_3_3_2,     GL_UNSIGNED_BYTE_2_3_3_REV,
		                          GL_UNSIGNED_SHORT_5_6_5,    GL_UNSIGNED_SHORT_5_6_5_REV,
		                          GL_UNSIGNED_SHORT_4_4_4_4,  GL_UNSIGNED_SHORT_4_4_4_4_REV,
		                          GL_UNSIGNED_SHORT_5_5_5_1,  GL_UNSIGNED_SHORT_1_5_5_5_REV,
		                          GL_UNSIGNED_INT_8_8_8_8,    GL_UNSIGNED_INT_8_8_8_8_REV,
		                          GL_UNSIGNED_INT_10_10_10_2, GL_UNSIGNED_INT_2_10_10_10_REV };
	const int t = choose(&i, 12), order = choose(&i, 2), swap = choose(&i, 2);

	place(-0.7f, -0.7f);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glPixelStorei(GL_UNPACK_SWAP_BYTES, swap);
	glDrawPixels(SIDE, SIDE, t < 4 ? GL_RGB : order ? GL_BGRA : GL_RGBA, types[t], bytes);
	glPixelStorei(GL_UNPACK_SWAP_BYTES, 0);
}

/* Row lengths and skips larger than the rectangle, with each alignment. */
static void draw_stored(int i)
{
	static const int alignments[4] = { 1, 2, 4, 8 };
	const int alignment = choose(&i, 4), length = choose(&i, 3), rows = choose(&i, 2), columns = choose(&i, 2),
		  bits = choose(&i, 2);

	place(-0.7f, -0.7f);
	glPixelStorei(GL_UNPACK_ALIGNMENT, alignments[alignment]);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, length ? SIDE + length : 0);
	glPixelStorei(GL_UNPACK_SKIP_ROWS, rows);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, columns);
	glPixelStorei(GL_UNPACK_LSB_FIRST, rows);
	if (bits)
		glBitmap(SIDE * 2 + 1, SIDE * 2, 1, 0, 0, 0, bytes);
	else
		glDrawPixels(SIDE - 1, SIDE - 1, GL_RGB, GL_UNSIGNED_BYTE, bytes);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
	glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
	glPixelStorei(GL_UNPACK_LSB_FIRST, 0);
}

/* Scale and bias of each channel, and the colour maps. */
static void transfer(int i)
{
	static const GLenum scales[4] = { GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE, GL_ALPHA_SCALE };
	static const GLenum biases[4] = { GL_RED_BIAS, GL_GREEN_BIAS, GL_BLUE_BIAS, GL_ALPHA_BIAS };
	static const GLenum maps[4] = { GL_PIXEL_MAP_R_TO_R, GL_PIXEL_MAP_G_TO_G, GL_PIXEL_MAP_B_TO_B, GL_PIXEL_MAP_A_TO_A };
	const int channel = choose(&i, 4), how = choose(&i, 6);
	float map[16];

	for (unsigned k = 0; k < 16; k++)
		map[k] = noise(k + 16 * (unsigned)channel);
	if (how == 0 || how == 2)
		glPixelTransferf(scales[channel], 0.6f);
	if (how == 1 || how == 2)
		glPixelTransferf(biases[channel], -0.2f);
	if (how == 3)
		glPixelTransferf(scales[channel], 2.5f);
	if (how >= 4) {
		glPixelMapfv(maps[channel], how == 4 ? 16 : 4, map);
		glPixelTransferi(GL_MAP_COLOR, GL_TRUE);
	}
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

/* glPopAttrib does not restore the maps. */
static void reset_maps(void)
{
	static const GLenum maps[4] = { GL_PIXEL_MAP_R_TO_R, GL_PIXEL_MAP_G_TO_G, GL_PIXEL_MAP_B_TO_B, GL_PIXEL_MAP_A_TO_A };

	for (unsigned k = 0; k < 4; k++)
		glPixelMapfv(maps[k], 2, (const float[2]){ 0, 1 });
}

static void draw_transferred(int i)
{
	draw_rgba(i);
	reset_maps();
}

/* Indices through shift, offset and maps. */
static void indexed(int i)
{
	const int shift = choose(&i, 5) - 2, offset = choose(&i, 3);
	static const GLenum maps[4] = { GL_PIXEL_MAP_I_TO_R, GL_PIXEL_MAP_I_TO_G, GL_PIXEL_MAP_I_TO_B, GL_PIXEL_MAP_I_TO_A };
	float map[16];

	for (unsigned m = 0; m < 4; m++) {
		for (unsigned k = 0; k < 16; k++)
			map[k] = noise(k + 100 * m);
		glPixelMapfv(maps[m], 16, map);
	}
	glPixelTransferi(GL_INDEX_SHIFT, shift);
	glPixelTransferi(GL_INDEX_OFFSET, 5 * offset);
}

static void draw_indexed(int i)
{
	place(-0.7f, -0.7f);
	glDrawPixels(SIDE, SIDE, GL_COLOR_INDEX, i % 2 ? GL_UNSIGNED_BYTE : GL_UNSIGNED_SHORT, bytes);
}

/* As drawn pixels, but uploaded as a texture. */
static void draw_uploaded(GLenum format, GLenum type)
{
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, format, type, bytes);
	glEnable(GL_TEXTURE_2D);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	glBegin(GL_QUADS);
	for (int c = 0; c < 4; c++) {
		glTexCoord2f(c == 1 || c == 2, c >= 2);
		glVertex2f(c == 1 || c == 2 ? 0.9f : -0.9f, c >= 2 ? 0.9f : -0.9f);
	}
	glEnd();
}

static void draw_transferred_texture(int i)
{
	place(0, 0);
	draw_uploaded(GL_RGBA, GL_UNSIGNED_BYTE);
	reset_maps();
	(void)i;
}

static void draw_indexed_texture(int i)
{
	place(0, 0);
	draw_uploaded(GL_COLOR_INDEX, i % 2 ? GL_UNSIGNED_BYTE : GL_UNSIGNED_SHORT);
}

static const float zooms[8] = { 1, 0.5f, 2.5f, -0.5f, -1.5f, 3, 0.6f, -1 };

/* Zooms of any size and sign, from positions between pixels. */
static void draw_zoomed(int i)
{
	const int x = choose(&i, 8), y = choose(&i, 8), copy = choose(&i, 2);
	GLfloat from[4];

	place(-0.97f, -0.97f);
	glGetFloatv(GL_CURRENT_RASTER_POSITION, from);
	glPixelZoom(1, 1);
	if (copy)
		glDrawPixels(SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
	glRasterPos3f(zooms[x] > 0 ? -0.77f : 0.77f, zooms[y] > 0 ? -0.61f : 0.83f, 0);
	glPixelZoom(zooms[x], zooms[y]);
	if (copy)
		glCopyPixels((GLint)rintf(from[0]), (GLint)rintf(from[1]), SIDE - x / 4, SIDE - y / 4, GL_COLOR);
	else
		glDrawPixels(SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
}

/* Show the depth or stencil buffer's contents by drawing with tests. */
static void show_passing(void)
{
	glColorMask(1, 1, 1, 1);
	glDepthFunc(GL_LESS);
	for (int k = 0; k < 5; k++) {
		glStencilFunc(GL_LESS, 51 * k, 0xff);
		glColor3f(0.2f * (float)k, 0.9f - 0.2f * (float)k, 0.4f);
		glBegin(GL_QUADS);
		for (int c = 0; c < 4; c++)
			glVertex3f(c == 1 || c == 2 ? 2.0f : -2.0f, c >= 2 ? 2.0f : -2.0f, 1.1f - 0.7f * (float)k);
		glEnd();
	}
}

/* Depths, stencils and both, copied and zoomed. */
static void draw_copied_depths(int i)
{
	static const GLenum kinds[3] = { GL_DEPTH, GL_STENCIL, GL_DEPTH_STENCIL };
	const int x = choose(&i, 8), y = choose(&i, 8), kind = choose(&i, 3),
		  shows_stencil = kind == 1 || (kind == 2 && x & 1);
	float values[SIDE * SIDE];
	GLfloat from[4];

	for (unsigned k = 0; k < SIDE * SIDE; k++)
		values[k] = noise(k + 400);
	place(-0.97f, -0.97f);
	glGetFloatv(GL_CURRENT_RASTER_POSITION, from);
	glPixelZoom(1, 1);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_ALWAYS);
	glColorMask(0, 0, 0, 0);
	glDrawPixels(SIDE, SIDE, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, bytes);
	glDrawPixels(SIDE, SIDE, GL_DEPTH_COMPONENT, GL_FLOAT, values);
	glRasterPos3f(zooms[x] > 0 ? -0.77f : 0.77f, zooms[y] > 0 ? -0.61f : 0.83f, 0);
	glPixelZoom(zooms[x], zooms[y]);
	glCopyPixels((GLint)rintf(from[0]), (GLint)rintf(from[1]), SIDE - x / 4, SIDE - y / 4, kinds[kind]);
	if (shows_stencil) {
		glDisable(GL_DEPTH_TEST);
		glEnable(GL_STENCIL_TEST);
	}
	show_passing();
}

/* Depths and stencils: drawn, then shown by drawing with tests. */
static void draw_depths(int i)
{
	const int stencil = choose(&i, 2), how = choose(&i, 4), type = choose(&i, 2);
	float values[SIDE * SIDE];

	for (unsigned k = 0; k < SIDE * SIDE; k++)
		values[k] = noise(k + 400);
	place(-0.7f, -0.7f);
	glEnable(stencil ? GL_STENCIL_TEST : GL_DEPTH_TEST);
	if (how == 1)
		glPixelTransferf(GL_DEPTH_SCALE, 0.5f);
	if (how == 2)
		glPixelTransferf(GL_DEPTH_BIAS, 0.3f);
	if (how == 3)
		glPixelTransferi(GL_INDEX_SHIFT, 1);
	glDepthFunc(GL_ALWAYS);
	glColorMask(0, 0, 0, 0);
	if (stencil)
		glDrawPixels(SIDE, SIDE, GL_STENCIL_INDEX, type ? GL_UNSIGNED_BYTE : GL_UNSIGNED_SHORT, bytes);
	else if (type)
		glDrawPixels(SIDE, SIDE, GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE, bytes);
	else
		glDrawPixels(SIDE, SIDE, GL_DEPTH_COMPONENT, GL_FLOAT, values);
	show_passing();
}

/* Later stages that rectangles pass through: textures, a lit raster position, tests, colour sum. */
static void through(int i)
{
	const int what = choose(&i, 8);

	glColor4f(0.9f, 0.5f, 0.3f, 0.7f);
	glSecondaryColor3f(0.2f, 0.4f, 0.6f);
	if (what == 1)
		glEnable(GL_COLOR_SUM);
	if (what == 2) {
		glEnable(GL_LIGHTING);
		glEnable(GL_LIGHT0);
		glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SEPARATE_SPECULAR_COLOR);
		glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[4]){ 1, 0.5f, 0.2f, 1 });
	}
	if (what == 3) {
		glEnable(GL_ALPHA_TEST);
		glAlphaFunc(GL_GREATER, 0.5f);
	}
	if (what == 4) {
		glEnable(GL_COLOR_LOGIC_OP);
		glLogicOp(GL_XOR);
	}
	if (what == 5)
		glColorMask(1, 0, 1, 0);
	if (what == 6) {
		glEnable(GL_CLIP_PLANE0);
		glClipPlane(GL_CLIP_PLANE0, (const double[4]){ 1, 0, 0, 0.2 });
	}
	if (what == 7) {
		glEnable(GL_DEPTH_TEST);
		glEnable(GL_POLYGON_STIPPLE);
		glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
	}
}

static void draw_through(int i)
{
	if (i / 8 == 0) {
		draw_rgba(i);
	} else if (i / 8 == 1) {
		place(-0.7f, -0.7f);
		glBitmap(SIDE * 2, SIDE * 2, 0, 0, 0, 0, bytes);
	} else {
		glRasterPos3f(-0.7f, -0.7f, 0);
		glPixelZoom(1.6f, 2);
		glCopyPixels(1, 1, 8, 6, GL_COLOR);
	}
}

/* --- Display lists (sec. 5.4): pixels are read when the list is made, from client memory or from a bound buffer --- */

static void give(int what, const unsigned char *pixels)
{
	switch (what) {
	case 0: glDrawPixels(SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, pixels); break;
	case 1: glBitmap(2 * SIDE, 2 * SIDE, 0, 0, 0, 0, pixels); break;
	case 2: glPolygonStipple(pixels); break;
	case 3: glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels); break;
	case 4: glTexSubImage2D(GL_TEXTURE_2D, 0, 1, 2, SIDE, 5, GL_RGB, GL_UNSIGNED_BYTE, pixels); break;
	default: glPixelMapfv(GL_PIXEL_MAP_R_TO_R, 16, (const float *)(const void *)pixels); break;
	}
}

static void draw_listed(int i)
{
	static const unsigned char nothing[sizeof(all_bytes)];
	static const float map[16] = { 0.9f, 0.1f, 0.8f, 0.3f,  0.7f,  0,     1,     0.5f,
		                       0.2f, 0.6f, 0.4f, 0.15f, 0.85f, 0.35f, 0.65f, 0.05f };
	/* Mesa (22.3.6) treats a map's buffer offset as a pointer */
	const int what = choose(&i, 6), in_buffer = choose(&i, 2) && what != 5;
	const int is_laid_out = choose(&i, 2), twice = choose(&i, 2);
	const size_t offset = what == 5 ? 8 : 3;
	const unsigned char *from = what == 5 ? (const unsigned char *)map : all_bytes;
	static unsigned char copy[2 * sizeof(all_bytes)];
	GLuint buffer;

	memcpy(copy + offset, from, what == 5 ? sizeof(map) : sizeof(all_bytes));
	glGenBuffers(1, &buffer);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, all_bytes + 5);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	if (in_buffer) {
		glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
		glBufferData(GL_PIXEL_UNPACK_BUFFER, sizeof(copy), copy, GL_STREAM_DRAW);
	}
	glPixelStorei(GL_UNPACK_ROW_LENGTH, is_laid_out ? 33 : 0);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, is_laid_out);
	for (GLuint list = 1; list <= 1 + (GLuint)twice; list++) { /* the same pixels in two lists; the last one is
	                                                              called */
		glNewList(list, GL_COMPILE);
		give(what, in_buffer ? (const unsigned char *)offset : copy + offset);
		glEndList();
	}
	if (in_buffer)
		glBufferData(GL_PIXEL_UNPACK_BUFFER, sizeof(nothing), nothing, GL_STREAM_DRAW);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
	place(-0.7f, -0.7f);
	glCallList(1 + (GLuint)twice);
	glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
	glDeleteBuffers(1, &buffer);
	glDeleteLists(1, 2);
	glPixelTransferi(GL_MAP_COLOR, what == 5);
	if (what == 5)
		draw_uploaded(GL_RGBA, GL_UNSIGNED_BYTE);
	glPixelTransferi(GL_MAP_COLOR, 0);
	if (what < 2 || what == 5) {
		reset_maps();
		return;
	}
	glEnable(what == 2 ? GL_POLYGON_STIPPLE : GL_TEXTURE_2D);
	glBegin(GL_QUADS);
	for (int k = 0; k < 4; k++) {
		const float x = k == 1 || k == 2, y = k > 1;

		glTexCoord2f(x, y);
		glVertex2f(2 * x - 1, 2 * y - 1);
	}
	glEnd();
}

int main(void)
{
	static const struct table tables[] = {
		{ 66, format, draw_format }, { 48, format, draw_packed }, { 96, format, draw_stored },
		{ 16, transfer, draw_transferred }, { 30, indexed, draw_indexed }, { 128, format, draw_zoomed },
		{ 16, format, draw_depths }, { 192, format, draw_copied_depths }, { 24, through, draw_through },
		{ 24, transfer, draw_transferred_texture }, { 30, indexed, draw_indexed_texture }, { 48, format, draw_listed },
	};

	DRAW_TABLES(tables, prepare);
	return 0;
}
