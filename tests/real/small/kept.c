/*
 * Values that Mesa keeps or fails to restore, unlike the specification; each case was found by random programs
 * (tests/generated). One frame each. Recorded by test_small.py.
 */
#include "tests/trace/window.h"

/* The alpha of an earlier glColor4 returns with glColor3, once the attribute has shrunk. */
static void mix_colors(GLenum primitive, int twice)
{
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (int k = 0; k <= twice; k++) {
		glBegin(primitive);
		for (int i = 0; i < 12; i++) {
			const float x = 4 + 5 * (float)(i / 4 * 4) + (i % 4 == 1 || i % 4 == 2 ? 14 : 0);
			const float alpha = 0.2f + 0.06f * (float)i;

			if (i % 3 == 1)
				glColor4f(1, 0.5f, 0.2f, alpha);
			else if (i % 5 == 0)
				glColor4ub(100, 200, 255, (GLubyte)(255 * alpha));
			else
				glColor3f(0.2f, 1, 0.3f);
			glVertex2f(x, (i % 4 < 2 ? 4 : 20) + 22 * (float)k);
		}
		glEnd();
	}
	glDisable(GL_BLEND);
}

static void mix_colors_of_quads(void)
{
	mix_colors(GL_QUADS, 1);
}
static void mix_colors_of_triangles(void)
{
	mix_colors(GL_TRIANGLES, 0);
}

/* Other types than float: Mesa makes glColor4f of them, with an alpha of 1. */
static void color3(int type)
{
	switch (type) {
	case 0: glColor3d(0.2, 1, 0.3); break;
	case 1: glColor3ub(51, 255, 77); break;
	case 2: glColor3usv((const GLushort[]){ 13107, 65535, 19660 }); break;
	case 3: glColor3i(429496729, 2147483647, 644245094); break;
	case 4: glColor3bv((const GLbyte[]){ 25, 127, 38 }); break;
	default: glColor3fv((const GLfloat[]){ 0.2f, 1, 0.3f });
	}
}

static void mix_types_of_colors(void)
{
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (int type = 0; type < 6; type++) {
		glBegin(GL_QUADS);
		for (int i = 0; i < 16; i++) {
			const float x = 4 + 14 * (float)(i / 4) + (i % 4 == 1 || i % 4 == 2 ? 12 : 0);

			if (i / 4 % 2)
				color3(type);
			else
				glColor4f(1, 0.5f, 0.2f, 0.3f);
			glVertex2f(x, (i % 4 < 2 ? 1 : 7) + 8 * (float)type);
		}
		glEnd();
	}
	glDisable(GL_BLEND);
}

static void mix_colors_between(void)
{
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (int i = 0; i < 6; i++) {
		if (i % 2)
			glColor3f(1, 1, 0);
		else
			glColor4f(0, 1, 1, 0.25f + 0.1f * (float)i);
		glRectf(4 + 9 * (float)i, 4, 12 + 9 * (float)i, 44);
	}
	glDisable(GL_BLEND);
}

/* A colour restored by PopAttrib does not become a material. */
static void pop_color(GLbitfield groups)
{
	const GLfloat black[4] = { 0, 0, 0, 1 }, toward[4] = { 0, 0, 1, 0 };

	glPushAttrib(GL_ALL_ATTRIB_BITS);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
	glLightfv(GL_LIGHT0, GL_POSITION, toward);
	glEnable(GL_LIGHT0);
	glEnable(GL_LIGHTING);
	glColorMaterial(GL_FRONT_AND_BACK, GL_DIFFUSE);
	glEnable(GL_COLOR_MATERIAL);
	glNormal3f(0, 0, 1);
	glColor3f(1, 0, 0);
	glRectf(2, 2, 20, 46);
	glPushAttrib(groups);
	glDisable(GL_COLOR_MATERIAL);
	if (groups != GL_ENABLE_BIT)
		glEnable(GL_COLOR_MATERIAL);
	glColor3f(0, 1, 0);
	glRectf(22, 2, 40, 46);
	glPopAttrib();
	glRectf(42, 2, 62, 46);
	glPopAttrib();
}

static void pop_current(void)
{
	pop_color(GL_CURRENT_BIT);
}
static void pop_current_and_lights(void)
{
	pop_color(GL_CURRENT_BIT | GL_LIGHTING_BIT);
}
static void pop_enabled(void)
{
	pop_color(GL_ENABLE_BIT);
}
static void pop_all(void)
{
	pop_color(GL_ALL_ATTRIB_BITS);
}

/* RasterPos lights with unmodified normals, whether NORMALIZE is on or not. */
static void light_bitmap(void)
{
	static const GLubyte bits[8] = { 255, 129, 129, 129, 129, 129, 129, 255 };
	const GLfloat toward[4] = { 0, 0.6f, 0.8f, 0 };

	glPushAttrib(GL_ALL_ATTRIB_BITS);
	glLightfv(GL_LIGHT0, GL_POSITION, toward);
	glEnable(GL_LIGHT0);
	glEnable(GL_LIGHTING);
	glEnable(GL_NORMALIZE);
	for (int i = 0; i < 4; i++) {
		glNormal3f(0, 0, 0.5f + 0.2f * (float)i);
		glRasterPos2f(4 + 14 * (float)i, 10);
		glBitmap(8, 8, 0, 0, 0, 0, bits);
	}
	glPopAttrib();
}

/* Bitmaps of no pixels between others, as the blanks of a font are: Mesa 22.3 loses those of lists at NULL. */
static void call_blanks(void)
{
	static const GLubyte bits[8] = { 255, 129, 129, 129, 129, 129, 129, 255 };
	const GLuint first = glGenLists(4);

	for (unsigned i = 0; i < 4; i++) {
		glRasterPos2f(4, 2 + 12 * (float)i);
		glNewList(first + i, i == 2 ? GL_COMPILE_AND_EXECUTE : GL_COMPILE);
		glBitmap(8, 8, 0, 0, 10, 0, bits);
		glBitmap(0, 0, 0, 0, 10, 0, i ? NULL : bits);
		if (i == 3)
			glBitmap(0, 0, 0, 0, 5, 2, NULL);
		glBitmap(8, 8, 0, 0, 10, 0, bits);
		glEndList();
		(void)glGetError();
		glCallList(first + i);
		glBitmap(0, 0, 0, 0, 3, 0, NULL);
		glBitmap(8, 8, 0, 0, 10, 0, bits);
	}
	glDeleteLists(first, 4);
}

int main(void)
{
	static void (*const frames[])(void) = { mix_colors_of_quads,
		                                mix_colors_of_triangles,
		                                mix_types_of_colors,
		                                mix_colors_between,
		                                pop_current,
		                                pop_current_and_lights,
		                                pop_enabled,
		                                pop_all,
		                                light_bitmap,
		                                call_blanks };

	open_window();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), begin_pixels);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
