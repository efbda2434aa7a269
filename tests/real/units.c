/*
 * Surfaces with several textures, one of them their own colour, distinguished by size: a shadow by alpha (2 x 2), a
 * reflection (8 x 8), and the colour (4 x 4). The first frame has the colour after shadow and reflection; the next has
 * the reflection first; the last has no colour. Recorded by test_export.py.
 */
#include "tests/trace/window.h"

enum { SHADOW, MIRROR, COLOR, N_TEXTURES };

static GLuint textures[N_TEXTURES];

static void make_textures(void)
{
	static const GLint sizes[N_TEXTURES] = { 2, 8, 4 };
	static unsigned char texels[8 * 8 * 4];

	for (unsigned i = 0; i < sizeof(texels); i++)
		texels[i] = (unsigned char)(40 + 3 * (i % 60));
	glGenTextures(N_TEXTURES, textures);
	for (int i = 0; i < N_TEXTURES; i++) {
		glBindTexture(GL_TEXTURE_2D, textures[i]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		glTexImage2D(GL_TEXTURE_2D, 0, i == SHADOW ? GL_LUMINANCE_ALPHA : GL_RGBA, sizes[i], sizes[i], 0,
		             GL_RGBA, GL_UNSIGNED_BYTE, texels);
	}
}

/* Bind one of the textures to a unit, with the environment for its purpose. */
static void use(int unit, int texture)
{
	glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
	glBindTexture(GL_TEXTURE_2D, textures[texture]);
	glEnable(GL_TEXTURE_2D);
	if (texture == MIRROR) {
		glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
		glTexGeni(GL_T, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
		glEnable(GL_TEXTURE_GEN_S);
		glEnable(GL_TEXTURE_GEN_T);
	} else {
		glDisable(GL_TEXTURE_GEN_S);
		glDisable(GL_TEXTURE_GEN_T);
	}
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, texture == SHADOW ? GL_COMBINE : GL_MODULATE);
	glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_MODULATE);
	glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB, GL_PREVIOUS);
	glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE1_RGB, GL_TEXTURE);
	glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND1_RGB, GL_ONE_MINUS_SRC_ALPHA);
}

static void draw(void)
{
	static const float corners[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };

	glClear(GL_COLOR_BUFFER_BIT);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		for (GLenum unit = 0; unit < 3; unit++)
			glMultiTexCoord2f(GL_TEXTURE0 + unit, corners[i][0], corners[i][1]);
		glVertex3f(corners[i][0], corners[i][1], -3);
	}
	glEnd();
	end_frame();
}

int main(void)
{
	static const int uses[3][3] = { { SHADOW, MIRROR, COLOR }, { MIRROR, SHADOW, COLOR }, { SHADOW, MIRROR, MIRROR } };

	open_window();
	make_textures();
	glMatrixMode(GL_PROJECTION);
	glFrustum(-1, 1, -1, 1, 1, 10);
	glMatrixMode(GL_MODELVIEW);
	for (int frame = 0; frame < 3; frame++) {
		for (int unit = 0; unit < 3; unit++)
			use(unit, uses[frame][unit]);
		draw();
	}
	return 0;
}
