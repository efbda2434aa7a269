/*
 * Stippled lines (OpenGL 2.1 sec. 3.4.2): where the pattern restarts and where it continues, for lines and strips and
 * for polygons drawn as lines, whole and clipped, from all ways of passing vertices.
 */
#include <math.h>

#include "panels.h"

enum { CORNERS = 12 };

enum way { IMMEDIATE, LIST, ARRAYS, ELEMENTS, N_WAYS, TWO_IN_LIST = N_WAYS, N_STRIP_WAYS };

static float corners[CORNERS][3];
static int n_corners;

/* Corners of a zigzag line whose segments do not have integer lengths. reach: their distance from the middle; the
 * square's side is 1 */
static void zigzag(int n, float reach, unsigned seed)
{
	n_corners = n;
	for (int i = 0; i < n; i++) {
		const float angle = 2.4f * (float)i + 0.7f * (float)seed, far = reach * (1 - 0.06f * (float)i);

		corners[i][0] = far * cosf(angle);
		corners[i][1] = far * sinf(angle);
		corners[i][2] = i & 1 ? -1.5f : 0.3f;
	}
}

/* Corners of a ring; in pairs, as quad strips need them */
static void round_of(int n, float reach, int by_pairs)
{
	n_corners = n;
	for (int i = 0; i < n; i++) {
		const int at = !by_pairs ? i : i & 1 ? n - 1 - i / 2 : i / 2;
		const float angle = 6.2831853f * ((float)at + 0.3f) / (float)n;

		corners[i][0] = reach * cosf(angle);
		corners[i][1] = reach * sinf(angle);
		corners[i][2] = 0;
	}
}

static void color_of(int i)
{
	glColor3f(0.3f + 0.6f * (float)(i & 1), 0.9f - 0.5f * (float)(i % 3 == 1), 0.4f + 0.2f * (float)(i % 4));
}

static void in_between(GLenum mode, int first, int n)
{
	glBegin(mode);
	for (int i = first; i < first + n; i++) {
		color_of(i);
		glVertex3fv(corners[i]);
	}
	glEnd();
}

static void draw_corners(enum way way, GLenum mode)
{
	static const GLubyte elements[CORNERS] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };

	if (way == IMMEDIATE) {
		in_between(mode, 0, n_corners);
	} else if (way == LIST || way == TWO_IN_LIST) {
		GLuint list = glGenLists(1);

		glNewList(list, GL_COMPILE);
		in_between(mode, 0, n_corners);
		if (way == TWO_IN_LIST)
			in_between(mode, 1, n_corners - 1);
		glEndList();
		glCallList(list);
		glDeleteLists(list, 1);
	} else {
		glColor3f(0.9f, 0.7f, 0.2f);
		glEnableClientState(GL_VERTEX_ARRAY);
		glVertexPointer(3, GL_FLOAT, 0, corners);
		if (way == ARRAYS)
			glDrawArrays(mode, 0, n_corners);
		else
			glDrawElements(mode, n_corners, GL_UNSIGNED_BYTE, elements);
		glDisableClientState(GL_VERTEX_ARRAY);
	}
}

static void pattern(int factor, int which)
{
	static const GLushort patterns[4] = { 0xf0f0, 0x2cf1, 0x00ff, 0xfffe };

	glEnable(GL_LINE_STIPPLE);
	glLineStipple(factor, patterns[which]);
}

static enum way way;
static GLenum mode;

/* Lines, strips, loops: each pattern and factor, passed in each way. */
static void strips(int i)
{
	static const GLenum modes[3] = { GL_LINE_STRIP, GL_LINES, GL_LINE_LOOP };
	int factor;

	mode = modes[choose(&i, 3)];
	way = (enum way)choose(&i, N_STRIP_WAYS);
	factor = choose(&i, 2);
	pattern(factor ? 3 : 1, choose(&i, 4));
	zigzag(6, 0.9f, (unsigned)i);
}

static void draw_strip(int i)
{
	(void)i;
	draw_corners(way, mode);
	zigzag(4, 0.8f, 77);
	draw_corners(way, mode);
}

/* The same with wide, flat and smooth lines. Smooth and flat are not combined: in Mesa (22.3.6), later lines that
 * are neither become flat. */
static void kinds(int i)
{
	static const GLenum modes[3] = { GL_LINE_STRIP, GL_LINES, GL_LINE_LOOP };

	const int m = choose(&i, 3), how = choose(&i, 3), width = choose(&i, 3), factor = choose(&i, 2);

	mode = modes[m];
	way = IMMEDIATE;
	if (how == 1) {
		glEnable(GL_LINE_SMOOTH);
		glEnable(GL_BLEND);
		glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	}
	glShadeModel(how == 2 ? GL_FLAT : GL_SMOOTH);
	glLineWidth(1 + 1.5f * (float)width);
	pattern(1 + factor, choose(&i, 2));
	zigzag(5, 0.9f, 5);
}

/*
 * Lines that leave the view volume, through its sides or clip planes, and return; with the first segment inside or
 * outside.
 */
static void cut(int i)
{
	static const GLenum modes[3] = { GL_LINE_STRIP, GL_LINES, GL_LINE_LOOP };

	mode = modes[choose(&i, 3)];
	way = choose(&i, 2) ? ELEMENTS : IMMEDIATE;
	pattern(2, choose(&i, 2));
	if (choose(&i, 2)) {
		glClipPlane(GL_CLIP_PLANE0, (const GLdouble[4]){ 1, 0.3, 0, 0.2 });
		glEnable(GL_CLIP_PLANE0);
	}
	zigzag(8, i & 1 ? 2.5f : 1.4f, (unsigned)i);
}

/* Corners shared by two lines: separate lines restart there, strips continue. */
static void shared(int i)
{
	int factor;

	mode = choose(&i, 2) ? GL_LINE_STRIP : GL_LINES;
	factor = choose(&i, 3);
	pattern(1 + factor, choose(&i, 4));
	zigzag(6, 0.9f, (unsigned)i);
}

static void draw_shared(int i)
{
	static const GLubyte elements[10] = { 0, 1, 1, 2, 2, 3, 3, 4, 4, 5 };

	(void)i;
	glColor3f(0.9f, 0.7f, 0.2f);
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(3, GL_FLOAT, 0, corners);
	glDrawElements(mode, 10, GL_UNSIGNED_BYTE, elements);
	glDisableClientState(GL_VERTEX_ARRAY);
}

/* Polygons drawn as lines: each mode, whole and clipped, flat and smooth, passed in each way. */
static void unfilled(int i)
{
	static const GLenum modes[6] = { GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN,
		                         GL_QUADS,     GL_QUAD_STRIP,     GL_POLYGON };

	mode = modes[choose(&i, 6)];
	way = (enum way)choose(&i, N_WAYS);
	glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
	glShadeModel(choose(&i, 2) ? GL_FLAT : GL_SMOOTH);
	pattern(2, choose(&i, 2));
	round_of(mode == GL_TRIANGLES ? 6 : 8, choose(&i, 2) ? 1.5f : 0.85f,
	         mode == GL_QUAD_STRIP || mode == GL_TRIANGLE_STRIP);
}

/* Edge flags: of triangles, quads and polygons, whole and clipped. */
static void edges(int i)
{
	static const GLenum modes[3] = { GL_TRIANGLES, GL_QUADS, GL_POLYGON };

	mode = modes[choose(&i, 3)];
	glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
	pattern(2, choose(&i, 2));
	round_of(mode == GL_TRIANGLES ? 6 : 8, choose(&i, 2) ? 1.5f : 0.85f, 0);
}

static void draw_edges(int i)
{
	glBegin(mode);
	for (int k = 0; k < n_corners; k++) {
		glEdgeFlag((k * k + k * i + i / 12) % 3 != 0);
		color_of(k);
		glVertex3fv(corners[k]);
	}
	glEnd();
	glEdgeFlag(GL_TRUE);
}

/* Chains of lines shorter than a pixel; one end is beside a pixel's centre, closer than llvmpipe's precision. */
static void short_chain(int i)
{
	const int by = choose(&i, 8), length = choose(&i, 3), beside = choose(&i, 2), width = choose(&i, 2);
	const float angle = 0.7853982f * (float)by + 0.4f, step = 0.16f * (float)(1 + length),
		    off = beside ? 0.0014f : -0.0014f;

	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, PANEL, 0, PANEL, -1, 1);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glLineWidth(width ? 5 : 1);
	glEnable(GL_BLEND);
	glBlendFunc(GL_ONE, GL_ONE);
	glColor3f(0.3f, 0.2f, 0.25f);
	n_corners = CORNERS;
	for (int k = 0; k < CORNERS; k++) {
		corners[k][0] = 10.5f + off + step * (float)(k - 5) * cosf(angle);
		corners[k][1] = 9.5f - off + step * (float)(k - 5) * sinf(angle);
		corners[k][2] = 0;
	}
}

static void draw_chain(int i)
{
	(void)i;
	glBegin(GL_LINE_STRIP);
	for (int k = 0; k < CORNERS; k++)
		glVertex3fv(corners[k]);
	glEnd();
	glDisable(GL_BLEND);
}

/* Lines across an image with mipmaps, coarse and fine, near and far, by fixed function and by a program. */
static void textured(int i)
{
	static const GLenum filters[4] = { GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR_MIPMAP_NEAREST,
		                           GL_NEAREST_MIPMAP_LINEAR };
	const int width = choose(&i, 3), filter = choose(&i, 4);

	glEnable(GL_TEXTURE_2D);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, (GLint)filters[filter]);
	glLineWidth(1 + (float)width);
	glEnable(GL_BLEND);
	glBlendFunc(GL_ONE, GL_ONE);
	if (i / 8 % 2)
		glEnable(GL_FRAGMENT_PROGRAM_ARB);
}

static void draw_textured(int i)
{
	static const float reach[4] = { 0.2f, 0.7f, 2.5f, 9 };
	const float s = reach[i / 12 % 4];

	zigzag(6, 0.9f, (unsigned)i);
	glBegin(i / 48 % 2 ? GL_LINES : GL_LINE_STRIP);
	for (int k = 0; k < 6; k++) {
		color_of(k);
		glTexCoord2f(s * noise((unsigned)(i * 6 + k)), s * noise((unsigned)(i * 6 + k + 4000)));
		glVertex3fv(corners[k]);
	}
	glEnd();
}

static void make_image_and_program(void)
{
	enum { SIDE = 64 };
	static GLubyte texels[SIDE * SIDE];
	static const char text[] = "!!ARBfp1.0\nTEMP t;\nTEX t, fragment.texcoord[0], texture[0], 2D;\nMUL "
	                           "result.color, t, fragment.color;\nEND\n";

	glProgramStringARB(GL_FRAGMENT_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, (GLsizei)strlen(text), text);

	for (int level = 0, side = SIDE; side; level++, side /= 2) {
		for (int k = 0; k < side * side; k++)
			texels[k] = (GLubyte)(255 * noise((unsigned)(k + 9000 * level)));
		glTexImage2D(GL_TEXTURE_2D, level, GL_LUMINANCE, side, side, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, texels);
	}
}

int main(void)
{
	static const struct table tables[] = { { 120, strips, draw_strip },     { 108, kinds, draw_strip },
		                               { 96, cut, draw_strip },         { 24, shared, draw_shared },
		                               { 192, unfilled, draw_strip },   { 96, edges, draw_edges },
		                               { 96, short_chain, draw_chain }, { 192, textured, draw_textured } };

	DRAW_TABLES(tables, make_image_and_program);
	return 0;
}
