/*
 * Behaviour of Mesa that differs from the specification, or that the specification leaves open; each case was found by
 * random programs (tests/generated). One frame each. Recorded by test_small.py.
 */
#include "tests/trace/window.h"

/* Any of the three offset switches applies to filled polygons: the second of two coplanar sheets is visible or not. */
static void offset(GLenum which, float units)
{
	glEnable(GL_DEPTH_TEST);
	glPolygonOffset(0, units);
	glColor3f(1, 0, 0);
	glRectf(4, 4, 40, 40);
	glEnable(which);
	glColor3f(0, 1, 0);
	glRectf(20, 20, 60, 44);
	glDisable(which);
	glDisable(GL_DEPTH_TEST);
}

static void offset_lines(void)
{
	offset(GL_POLYGON_OFFSET_LINE, -10);
}
static void offset_points(void)
{
	offset(GL_POLYGON_OFFSET_POINT, -10);
}
static void offset_behind(void)
{
	offset(GL_POLYGON_OFFSET_LINE, 10);
}

/* Each switch applies to its own kind of polygon only if llvmpipe draws in stages, as for stippled and smooth lines. */
static void offset_beside(GLenum other)
{
	glEnable(other);
	offset(GL_POLYGON_OFFSET_LINE, -10);
	glDisable(other);
}

static void offset_beside_stipple(void)
{
	glLineStipple(1, 0x5555);
	offset_beside(GL_LINE_STIPPLE);
	glLineStipple(1, 0xffff);
}

static void offset_beside_whole_lines(void)
{
	offset_beside(GL_LINE_STIPPLE);
}
static void offset_beside_smooth_points(void)
{
	offset_beside(GL_POINT_SMOOTH);
}

/* Edge flags apply to strips and fans, too. */
static void outline(GLenum primitive)
{
	static const GLfloat corners[8][2] = { { 8, 8 },  { 8, 40 },  { 24, 8 },  { 24, 40 },
		                               { 40, 8 }, { 40, 40 }, { 56, 12 }, { 56, 36 } };

	glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
	glBegin(primitive);
	for (int i = 0; i < 8; i++) {
		glEdgeFlag((GLboolean)(i % 3 != 0));
		glVertex2fv(corners[i]);
	}
	glEnd();
	glEdgeFlag(GL_TRUE);
	glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

static void outline_strip(void)
{
	outline(GL_TRIANGLE_STRIP);
}
static void outline_fan(void)
{
	outline(GL_TRIANGLE_FAN);
}
static void outline_quad_strip(void)
{
	outline(GL_QUAD_STRIP);
}

static void set_texture(GLenum target, int width, int height, GLint smaller, GLint larger)
{
	GLubyte texels[16 * 16 * 4];

	for (int i = 0; i < width * height; i++) {
		texels[4 * i] = (GLubyte)(i % width * 255 / width);
		texels[4 * i + 1] = (GLubyte)(i / width * 255 / height);
		texels[4 * i + 2] = (GLubyte)(i % 3 * 100);
		texels[4 * i + 3] = 255;
	}
	glTexImage2D(target, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(target, GL_TEXTURE_MIN_FILTER, smaller);
	glTexParameteri(target, GL_TEXTURE_MAG_FILTER, larger);
	glEnable(target);
}

static void textured_square(float s, float t)
{
	glBegin(GL_QUADS);
	glTexCoord2f(0, 0);
	glVertex2f(4, 4);
	glTexCoord2f(s, 0);
	glVertex2f(60, 4);
	glTexCoord2f(s, t);
	glVertex2f(60, 44);
	glTexCoord2f(0, t);
	glVertex2f(4, 44);
	glEnd();
}

/* While point sprites replace texture coordinates, other primitives have none. */
static void leave_sprites(GLint smaller, GLint larger)
{
	set_texture(GL_TEXTURE_2D, 16, 16, smaller, larger);
	glEnable(GL_POINT_SPRITE);
	glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, GL_TRUE);
	textured_square(1, 1);
	glPointSize(16);
	glBegin(GL_POINTS);
	glVertex2f(32, 24);
	glEnd();
	glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, GL_FALSE);
	glDisable(GL_POINT_SPRITE);
	glDisable(GL_TEXTURE_2D);
}

static void leave_sprites_on(void)
{
	leave_sprites(GL_NEAREST, GL_NEAREST);
}
static void leave_blended_sprites_on(void)
{
	leave_sprites(GL_LINEAR, GL_LINEAR);
}

static void leave_sprites_on_by_two_filters(void)
{
	leave_sprites(GL_NEAREST, GL_LINEAR);
}

/* Whether texels of rectangle textures are smaller than pixels is decided with coordinates multiplied by the size. */
static void filter_rectangle(float texels)
{
	set_texture(GL_TEXTURE_RECTANGLE, 16, 8, GL_LINEAR, GL_NEAREST);
	textured_square(texels, texels / 2);
	glDisable(GL_TEXTURE_RECTANGLE);
}

static void filter_large_rectangle(void)
{
	filter_rectangle(10);
}
static void filter_huge_rectangle(void)
{
	filter_rectangle(1.5f);
}

/* The last texture coordinates return like the alpha of colours (kept.c). */
static void mix_coordinates(void)
{
	set_texture(GL_TEXTURE_2D, 16, 16, GL_NEAREST, GL_NEAREST);
	for (int i = 0; i < 3; i++) {
		glBegin(GL_QUADS);
		glTexCoord4f(0, 0, 0, 2);
		glVertex2f(4 + 20 * (float)i, 4);
		glTexCoord2f(1, 0);
		glVertex2f(20 + 20 * (float)i, 4);
		glTexCoord4f(1, 1, 0, 1.5f);
		glVertex2f(20 + 20 * (float)i, 44);
		glTexCoord2f(0, 1);
		glVertex2f(4 + 20 * (float)i, 44);
		glEnd();
	}
	glDisable(GL_TEXTURE_2D);
}

/* Coordinates that are constant over a draw fall exactly on a texel's edge. */
static void stay_on_edge(void)
{
	static const GLfloat corners[4][3] = { { -9, -6, -12 }, { 8, -7, -25 }, { 9, 6, -14 }, { -7, 8, -30 } };

	set_texture(GL_TEXTURE_2D, 16, 16, GL_NEAREST, GL_NEAREST);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.7, 0.7, -0.5, 0.5, 1, 50);
	glMatrixMode(GL_MODELVIEW);
	glTexCoord2f(0.4375f, 1.0625f);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++)
		glVertex3fv(corners[i]);
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

/* If the texture of the first target is incomplete, that of the next target is used. */
static void leave_cube_map(void)
{
	const GLubyte texel[4] = { 255, 255, 255, 255 };
	GLuint texture;

	set_texture(GL_TEXTURE_2D, 16, 16, GL_NEAREST, GL_NEAREST);
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_CUBE_MAP, texture);
	glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
	glEnable(GL_TEXTURE_CUBE_MAP);
	textured_square(1, 1);
	glDisable(GL_TEXTURE_CUBE_MAP);
	glDeleteTextures(1, &texture);
	glDisable(GL_TEXTURE_2D);
}

/* Edge flags in arrays, element by element. */
static void outline_elements(void)
{
	static const struct {
		GLfloat place[2];
		GLboolean edge;
	} corners[4] = { { { 8, 8 }, 1 }, { { 56, 4 }, 0 }, { { 50, 44 }, 1 }, { { 4, 38 }, 1 } };

	glVertexPointer(2, GL_FLOAT, sizeof(corners[0]), corners[0].place);
	glEdgeFlagPointer(sizeof(corners[0]), &corners[0].edge);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_EDGE_FLAG_ARRAY);
	glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++)
		glArrayElement(i);
	glEnd();
	glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
	glDisableClientState(GL_EDGE_FLAG_ARRAY);
	glDisableClientState(GL_VERTEX_ARRAY);
	glEdgeFlag(GL_TRUE);
}

/* The diagonal that splits a quad depends on whether clip planes clip it, and on stipple. */
static void colored_quad(void)
{
	glBegin(GL_QUADS);
	glColor3f(1, 0, 0);
	glVertex2f(8, 8);
	glColor3f(0, 1, 0);
	glVertex2f(56, 4);
	glColor3f(0, 0, 1);
	glVertex2f(50, 44);
	glColor3f(1, 1, 1);
	glVertex2f(4, 38);
	glEnd();
}

static void clip_quad(double beyond)
{
	const double plane[4] = { 1, 0, 0, -beyond };

	glClipPlane(GL_CLIP_PLANE2, plane);
	glEnable(GL_CLIP_PLANE2);
	colored_quad();
	glDisable(GL_CLIP_PLANE2);
}

static void clip_beside(void)
{
	clip_quad(2);
}
static void clip_through(void)
{
	clip_quad(20);
}

static void stipple_quad(void)
{
	GLubyte pattern[128];

	for (int i = 0; i < 128; i++)
		pattern[i] = (GLubyte)(i / 4 % 2 ? 0x77 : 0xdd);
	glPolygonStipple(pattern);
	glEnable(GL_POLYGON_STIPPLE);
	colored_quad();
	glDisable(GL_POLYGON_STIPPLE);
}

/* It also depends on offsets and on two-sided lighting, together with smooth lines. */
static void quad_by_stages(GLenum other)
{
	const GLfloat light[4] = { 0, 0, 1, 0 };

	glPushAttrib(GL_ALL_ATTRIB_BITS);
	glEnable(other);
	glEnable(GL_POLYGON_OFFSET_LINE);
	colored_quad();
	glDisable(GL_POLYGON_OFFSET_LINE);
	glTranslatef(-20, 0, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, light);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
	glEnable(GL_LIGHT0);
	glEnable(GL_LIGHTING);
	glEnable(GL_COLOR_MATERIAL);
	glNormal3f(0, 0, 1);
	colored_quad();
	glTranslatef(20, 0, 0);
	glPopAttrib();
}

static void quad_beside_smooth_lines(void)
{
	quad_by_stages(GL_LINE_SMOOTH);
}
static void quad_beside_dithering(void)
{
	quad_by_stages(GL_DITHER);
}

/* The same in a list drawn while it is compiled, both from vertices and from arrays with indices; but not when the
 * list is called. */
static void list_quad(int by_arrays, int mode)
{
	static const GLfloat places[4][2] = { { 8, 8 }, { 56, 4 }, { 50, 44 }, { 4, 38 } };
	static const GLubyte colors[4][4] = {
		{ 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 }, { 255, 255, 255, 255 }
	};
	static const GLubyte order[4] = { 0, 1, 2, 3 };
	const GLuint list = glGenLists(1);

	glVertexPointer(2, GL_FLOAT, 0, places);
	glColorPointer(4, GL_UNSIGNED_BYTE, 0, colors);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	glNewList(list, (GLenum)mode);
	if (by_arrays)
		glDrawElements(GL_QUADS, 4, GL_UNSIGNED_BYTE, order);
	else
		glDrawArrays(GL_QUADS, 0, 4);
	glEndList();
	glDisableClientState(GL_VERTEX_ARRAY);
	glDisableClientState(GL_COLOR_ARRAY);
	if (mode == GL_COMPILE)
		glCallList(list);
}

static void make_list_of_arrays(void)
{
	list_quad(0, GL_COMPILE_AND_EXECUTE);
}
static void make_list_of_indices(void)
{
	list_quad(1, GL_COMPILE_AND_EXECUTE);
}
static void call_list_of_arrays(void)
{
	list_quad(0, GL_COMPILE);
}

/* Calls have no effect without an accumulation buffer. */
static void sum_nothing(void)
{
	colored_quad();
	glAccum(GL_LOAD, 0.5f);
	glAccum(GL_RETURN, 1);
	expect(glGetError() == GL_INVALID_OPERATION, "there is no accumulation buffer");
}

int main(void)
{
	static void (*const frames[])(void) = { offset_lines,
		                                offset_points,
		                                offset_behind,
		                                offset_beside_stipple,
		                                offset_beside_whole_lines,
		                                offset_beside_smooth_points,
		                                outline_strip,
		                                outline_fan,
		                                outline_quad_strip,
		                                leave_sprites_on,
		                                leave_blended_sprites_on,
		                                leave_sprites_on_by_two_filters,
		                                filter_large_rectangle,
		                                filter_huge_rectangle,
		                                mix_coordinates,
		                                clip_beside,
		                                clip_through,
		                                stipple_quad,
		                                quad_beside_smooth_lines,
		                                quad_beside_dithering,
		                                make_list_of_arrays,
		                                make_list_of_indices,
		                                call_list_of_arrays,
		                                stay_on_edge,
		                                leave_cube_map,
		                                outline_elements,
		                                sum_nothing };

	open_window();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), begin_pixels);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
