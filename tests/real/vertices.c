/*
 * Unusual vertex data, one kind per frame: NaN colours, positions with w other than 1 under lights and fog, and user
 * clip planes. Recorded by test_vertices.py.
 */
#include <math.h>

#include "tests/trace/window.h"

static void reset(void)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, 64, 0, 48, -10, 10);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glClearColor(0.2f, 0.4f, 0.6f, 0.4f);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glColor4f(1, 1, 1, 1);
}

/* A fan of six triangles whose middle has another alpha than its rim. */
static void puff(float x, float y, float size, float alpha)
{
	glBegin(GL_TRIANGLE_FAN);
	glColor4f(0.8f, 0.4f, 0.2f, alpha);
	glVertex2f(x, y);
	glColor4f(0, 0, 0, 0);
	for (int i = 0; i <= 6; i++)
		glVertex2f(x + size * cosf((float)i * 1.0472f), y + size * sinf((float)i * 1.0472f));
	glEnd();
}

/* As hufo_smoke draws its smoke: the square root of a negative number as alpha; inside the window, and clipped by
 * its edge. */
static void no_numbers(void)
{
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE);
	puff(16, 20, 15, NAN);
	puff(48, 46, 15, NAN);
	puff(48, 12, 10, INFINITY);
	puff(56, 30, 10, -INFINITY);
	glDisable(GL_BLEND);
	glColor4f(NAN, 0.5f, 0.2f, 1); /* the current colour, for all vertices */
	glRecti(2, 38, 10, 46);
	glBegin(GL_TRIANGLES);
	glColor4f(0.2f, NAN, 0.4f, 1);
	glVertex2i(14, 38);
	glColor4f(0.2f, 0.4f, 0.4f, 1);
	glVertex2i(26, 38);
	glColor4f(0.8f, 0.4f, NAN, 1);
	glVertex2i(14, 46);
	glEnd();
}

static void panel(float x, float y, float w)
{
	glBegin(GL_QUADS);
	glVertex4f(x * w, y * w, w, w);
	glVertex4f((x + 14) * w, y * w, 2 * w, w);
	glVertex4f((x + 14) * w, (y + 14) * w, 3, 1.5f * w);
	glVertex4f(x * w, (y + 14) * w, 4 * w, w);
	glEnd();
}

/* Distances to lights and viewer, spots and fog, with w varying from vertex to vertex; a light whose own w is not 1. */
static void divided(void)
{
	static const float place[4] = { 10, 15, 6, 1 }, shared[4] = { 60, 10, 12, 2 }, down[3] = { 0, 0, -1 },
			   grey[4] = { 0.2f, 0.2f, 0.2f, 1 };

	glLightfv(GL_LIGHT0, GL_POSITION, place);
	glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, 0.05f);
	glLightfv(GL_LIGHT1, GL_POSITION, shared);
	glLightfv(GL_LIGHT1, GL_DIFFUSE, grey);
	glLightfv(GL_LIGHT1, GL_SPECULAR, grey);
	glMaterialf(GL_FRONT, GL_SHININESS, 8);
	glMaterialfv(GL_FRONT, GL_SPECULAR, grey);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	panel(2, 2, 1);
	panel(18, 2, 1.5f);
	glEnable(GL_LIGHT1);
	panel(34, 2, 0.75f);
	glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, 1);
	panel(2, 18, 1.25f);
	glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, 60);
	glLightf(GL_LIGHT0, GL_SPOT_EXPONENT, 2);
	glLightfv(GL_LIGHT0, GL_SPOT_DIRECTION, down);
	panel(18, 18, 0.5f);
	glDisable(GL_LIGHTING);
	glEnable(GL_FOG);
	glFogi(GL_FOG_MODE, GL_LINEAR);
	glFogf(GL_FOG_END, 8);
	panel(34, 18, 1.5f);
	glDisable(GL_FOG);
}

static void plane(int i, double a, double b, double c, double d)
{
	double equation[4] = { a, b, c, d };

	glClipPlane(GL_CLIP_PLANE0 + (unsigned)i, equation);
	glEnable(GL_CLIP_PLANE0 + (unsigned)i);
}

/* A star of triangles, lines or points. */
static void star(unsigned mode)
{
	glBegin(mode);
	for (int i = 0; i < 27; i++) {
		float a = 2.3f * (float)i;

		glColor3f(0.5f + 0.5f * sinf(a), 0.5f + 0.5f * cosf(a), (float)(i % 3) / 2);
		glVertex3f((8 + (float)(i % 3) * 5) * cosf(a), (8 + (float)(i % 4) * 4) * sinf(a), (float)(i % 5 - 2));
	}
	glEnd();
}

/* The parts on both sides of planes, added up, so that gaps and overlaps show; also along diagonals through pixel
 * centres. */
static void planes(void)
{
	static const unsigned modes[] = { GL_TRIANGLES, GL_LINES, GL_POINTS };

	glEnable(GL_BLEND);
	glBlendFunc(GL_ONE, GL_ONE);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-32, 32, -24, 24, 20, 60);
	glTranslatef(0, 0, -20.5f);
	glMatrixMode(GL_MODELVIEW);
	for (int sign = -1; sign < 2; sign += 2) {
		glLoadIdentity();
		plane(0, sign, sign, 0, 0);
		glRotatef(20, 0, 1, 0);
		glTranslatef(-12, 6, -3);
		glPointSize(5);
		for (unsigned i = 0; i < 3; i++) {
			star(modes[i]);
			glTranslatef(i ? 22 : 6, i ? 2 : -14, 0);
		}
	}
	plane(1, 1, 0, 0.5, 11);
	plane(2, 0.3, -1, 0.2, 7.5);
	plane(3, 0, 1, 0.1, 9.25);
	star(GL_TRIANGLES);
	star(GL_LINE_STRIP);
	for (unsigned i = 0; i < 4; i++)
		glDisable(GL_CLIP_PLANE0 + i);
	glDisable(GL_BLEND);
}

/* An octagon cut from a square by eight planes, and the same added as a polygon. */
static void octagon(void)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glEnable(GL_BLEND);
	glBlendFunc(GL_ONE, GL_ONE);
	for (int i = 0; i < 8; i++)
		plane(i, cos(0.78539816 * i), sin(0.78539816 * i), 0, 0.5);
	glColor3f(0, 0.5f, 0);
	glRectf(-1, -1, 1, 1);
	for (unsigned i = 0; i < 8; i++)
		glDisable(GL_CLIP_PLANE0 + i);
	glColor3f(0.8f, 0, 0.4f);
	glBegin(GL_POLYGON);
	for (int i = 0; i < 8; i++)
		glVertex2d(0.5 / cos(0.39269908) * cos(0.78539816 * (i + 0.5)), 0.5 / cos(0.39269908) * sin(0.78539816 * (i + 0.5)));
	glEnd();
	glDisable(GL_BLEND);
}

/* All kinds of primitives, each vertex with another colour, under flat shading with either convention
 * (ARB_provoking_vertex). */
static void provoking(void)
{
	static const unsigned modes[] = { GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS,    GL_QUAD_STRIP,
		                          GL_POLYGON,   GL_LINES,          GL_LINE_STRIP,   GL_LINE_LOOP };

	glShadeModel(GL_FLAT);
	for (int k = 0; k < 2; k++) {
		glProvokingVertex(k ? GL_LAST_VERTEX_CONVENTION : GL_FIRST_VERTEX_CONVENTION);
		for (int m = 0; m < 9; m++) {
			float x0 = 7 * (float)m + 3.5f, y0 = 24 * (float)k + 12;

			glBegin(modes[m]);
			for (int i = 0; i < 12; i++) {
				int round = m == 2 || m == 5 || m == 8;
				float a = 0.5f * (float)i, x = round ? 3.2f * cosf(a) : (float)(i % 2 ? 3 : -3),
				      y = round ? 10 * sinf(a) : 1.8f * (float)(i / 2) - 5;

				if (m == 3 && i % 4 > 1)
					x = -x;
				glColor3f((float)(i & 1), (float)(i >> 1 & 1) * 0.9f, (float)(i >> 2) / 3);
				glVertex2f(x0 + x, y0 + y);
			}
			glEnd();
		}
	}
	glShadeModel(GL_SMOOTH);
}

/* Pack components of 10, 10, 10 and 2 bits. */
static unsigned pack(int x, int y, int z, int w)
{
	return (unsigned)(x & 1023) | (unsigned)(y & 1023) << 10 | (unsigned)(z & 1023) << 20 | (unsigned)(w & 3) << 30;
}

/* Packed positions, colours, normals and texture coordinates, passed one by one, and positions and colours also as
 * arrays (ARB_vertex_type_2_10_10_10_rev). */
static void packed(void)
{
	static const int corners[4][2] = { { 4, 4 }, { 28, 4 }, { 28, 20 }, { 4, 20 } };
	static const float beside[4] = { 0, 0.3f, 1, 0 }, white[4] = { 1, 1, 1, 1 };
	static const unsigned char texels[2][2][4] = { { { 255, 0, 0, 255 }, { 0, 255, 0, 255 } },
		                                       { { 0, 0, 255, 255 }, { 255, 255, 0, 255 } } };
	unsigned positions[4], colors[4], normals[4];

	for (int i = 0; i < 4; i++) {
		positions[i] = pack(corners[i][0], corners[i][1] + 24, -3, 1);
		colors[i] = pack(200 * i, 900 - 200 * i, 1023, 3);
		normals[i] = pack(-200 + 100 * i, 100, 511 - 250 * i, 0);
	}
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		glColorP4ui(GL_UNSIGNED_INT_2_10_10_10_REV, pack(300 * i, 500, 1000 - 300 * i, 3));
		glVertexP3ui(GL_INT_2_10_10_10_REV, pack(corners[i][0], corners[i][1], i - 2, 0));
	}
	glEnd();
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	glVertexPointer(4, GL_INT_2_10_10_10_REV, 0, positions);
	glColorPointer(4, GL_UNSIGNED_INT_2_10_10_10_REV, 0, colors);
	glDrawArrays(GL_QUADS, 0, 4);
	glVertexPointer(3, GL_INT_2_10_10_10_REV, 0, normals); /* refused: it must have four components */
	glColorPointer(3, GL_INT_2_10_10_10_REV, 0, normals);
	expect(glGetError() == GL_INVALID_OPERATION, "packed arrays of three components are refused");
	glTranslatef(0, -2, 0);
	glDrawArrays(GL_QUADS, 0, 4);
	glDisableClientState(GL_COLOR_ARRAY);
	glDisableClientState(GL_VERTEX_ARRAY);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, beside);
	glLightfv(GL_LIGHT0, GL_DIFFUSE, white);
	glTranslatef(32, 0, 0);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		glNormalP3ui(GL_INT_2_10_10_10_REV, normals[i]);
		glVertexP4ui(GL_INT_2_10_10_10_REV, positions[i]);
	}
	glEnd();
	glDisable(GL_LIGHT0);
	glDisable(GL_LIGHTING);
	glColor3f(1, 1, 1);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glEnable(GL_TEXTURE_2D);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		glTexCoordP2uiv(GL_UNSIGNED_INT_2_10_10_10_REV, (unsigned[1]){ pack(i == 1 || i == 2 ? 3 : 0, i > 1 ? 2 : 0, 0, 0) });
		glVertexP2ui(GL_UNSIGNED_INT_2_10_10_10_REV, pack(corners[i][0], corners[i][1], 0, 0));
	}
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

int main(void)
{
	static void (*const frames[])(void) = { no_numbers, divided, planes, octagon, provoking, packed };

	open_window();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), reset);
	return 0;
}
