/*
 * Shapes whose pixels depend on the last bits of Mesa's arithmetic, one kind per frame: lines of all slopes and widths;
 * lines, also smooth ones, drawn twice under GL_LESS; rotated and coplanar surfaces; material changes between Begin and
 * End; points; evaluators; incomplete quads. Recorded by test_shapes.py.
 */
#include <math.h>

#include "tests/trace/window.h"

enum { SPOKES = 40, STEPS = 24 };

static void reset(void)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.41, 0.41, -0.307, 0.307, 1, 37.3);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_LESS);
}

static void spokes(void)
{
	for (int width = 1; width < 4; width++) {
		glLineWidth((float)width);
		glBegin(GL_LINES);
		for (int i = 0; i < SPOKES; i++) {
			float angle = 6.2831853f * (float)i / SPOKES + 0.013f * (float)width, near = 0.05f,
			      far = width < 3 ? 0.3f * (float)width : 4; /* out of view */

			glColor3f((float)i / SPOKES, 1 - (float)i / SPOKES, 0.6f);
			glVertex3f(near * cosf(angle), near * sinf(angle), -2);
			glVertex3f(far * cosf(angle), far * sinf(angle), -2 - 0.5f * (float)width);
		}
		glEnd();
	}
	glLineWidth(1);
}

/* A net of wide lines, drawn twice: at equal depth the first one remains. */
static void net(void)
{
	glTranslatef(0.1f, 0, -3);
	glRotatef(33, 1, 0.3f, 0);
	glLineWidth(2);
	for (int pass = 0; pass < 2; pass++) {
		for (int i = 0; i < STEPS; i++) {
			float low = 3.1415927f * (float)i / STEPS, high = 3.1415927f * (float)(i + 1) / STEPS;

			glColor3f(pass ? 1 : 0.2f, pass ? 0.8f : 0.2f, 0.2f);
			glBegin(GL_LINE_STRIP);
			for (int k = 0; k <= STEPS; k++) {
				float around = 6.2831853f * (float)k / STEPS, a = pass ? high : low, b = pass ? low : high;

				glVertex3f(sinf(a) * cosf(around), cosf(a), sinf(a) * sinf(around));
				glVertex3f(sinf(b) * cosf(around), cosf(b), sinf(b) * sinf(around));
			}
			glEnd();
		}
	}
	glLineWidth(1);
}

/* The same smooth: their rims, which cover pixels partly, also write depth. */
static void smooth_net(void)
{
	glEnable(GL_LINE_SMOOTH);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glTranslatef(-0.2f, -0.05f, -0.3f); /* completely in view */
	net();
	glDisable(GL_BLEND);
	glDisable(GL_LINE_SMOOTH);
}

/* As fieldlines draws: strips with every vertex doubled, so that every other smooth line has zero length. */
static void smooth_dots(void)
{
	glEnable(GL_LINE_SMOOTH);
	for (int k = 0; k < 6; k++) {
		glLineWidth(1.3f + 0.7f * (float)k);
		glBegin(GL_LINE_STRIP);
		for (int i = 0; i < 24; i++) {
			float t = 0.17f * (float)(i / 2 * 2) + (float)k;

			glColor3f(0.5f + 0.5f * sinf(3 * t), 0.5f + 0.5f * cosf(5 * t), (float)(i / 2 % 3) / 2);
			glVertex3f(1.4f * sinf(2 * t), 1.1f * cosf(3 * t), -4 + sinf(t));
		}
		glEnd();
	}
	glLineWidth(1);
	glDisable(GL_LINE_SMOOTH);
}

/* Coplanar surfaces: the last bit of their depths determines which one is visible. */
static void coplanar(void)
{
	glTranslatef(0, 0, -4);
	glRotatef(-61.7f, 1, 0, 0);
	glRotatef(23.9f, 0, 0, 1);
	for (int i = 0; i < STEPS; i++) {
		float a = 0.41f * (float)i, b = a + 2.1f, c = b + 2.1f;

		glColor3f((float)(i & 1), (float)(i & 2) / 2, (float)(i & 4) / 4);
		glBegin(GL_TRIANGLES);
		glVertex3f(cosf(a), sinf(a), 0.25f * cosf(a));
		glVertex3f(cosf(b), sinf(b), 0.25f * cosf(b));
		glVertex3f(cosf(c), sinf(c), 0.25f * cosf(c));
		glEnd();
	}
}

/* Each vertex uses the material that was current when it was passed (GL 2.1 sec. 2.6.3). */
static void materials(void)
{
	static const float where[4] = { 0.3f, 0.2f, 1, 0 };
	static const GLenum modes[4] = { GL_TRIANGLE_STRIP, GL_QUADS, GL_TRIANGLE_FAN, GL_LINE_LOOP };

	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, where);
	glNormal3f(0.1f, 0.2f, 0.97f);
	for (int m = 0; m < 4; m++) {
		glBegin(modes[m]);
		for (int i = 0; i < 8; i++) {
			float color[4] = { (float)(i & 1), (float)(i >> 1 & 1), (float)(i >> 2), 1 }, shine = (float)(i * 10);
			float x = (float)(i / 2) * 0.3f - 0.5f, y = (float)((i + 1) / 2 & 1) * 0.2f + 0.3f * (float)m - 0.5f;

			glMaterialfv(GL_FRONT_AND_BACK, i % 3 ? GL_DIFFUSE : GL_EMISSION, color);
			glMaterialfv(GL_FRONT, GL_SPECULAR, color);
			glMaterialfv(GL_FRONT_AND_BACK, GL_SHININESS, &shine);
			glVertex3f(x, y, -2);
		}
		glEnd();
	}
	glDisable(GL_LIGHTING);
}

/* Points of all sizes, and a light so far away that its distance overflows. */
static void points(void)
{
	static const float far_away[4] = { 0, 20, -1, -3e-34f }, near[4] = { 0, 0, 1, 0 };

	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_LIGHT1);
	glLightfv(GL_LIGHT0, GL_POSITION, near);
	glLightfv(GL_LIGHT1, GL_POSITION, far_away);
	glLightfv(GL_LIGHT1, GL_DIFFUSE, near);
	glRotatef(9, 0.3f, 0.5f, 1);
	for (int size = 0; size < 6; size++) {
		glPointSize(1 + 0.5f * (float)size);
		glBegin(GL_POINTS);
		for (int i = 0; i < SPOKES; i++) {
			glNormal3f((float)i / SPOKES, 0.2f, 0.7f);
			glVertex3f(0.03f * (float)i - 0.6f, 0.13f * (float)size - 0.33f + 0.0007f * (float)i, -2);
		}
		glEnd();
	}
	glDisable(GL_LIGHTING);
	glDisable(GL_LIGHT1);
}

/* Sprites whose size shrinks with distance, far from the middle of the view. */
static void far_sprites(void)
{
	static const float fade[3] = { 0, 0, 1 }, whole[3] = { 1, 0, 0 };
	GLubyte texels[16][16][4];

	for (int i = 0; i < 16 * 16; i++)
		for (int k = 0; k < 4; k++)
			texels[i / 16][i % 16][k] = (GLubyte)((15 - abs(2 * (i % 16) - 15)) * (15 - abs(2 * (i / 16) - 15)));
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glEnable(GL_TEXTURE_2D);
	glEnable(GL_POINT_SPRITE);
	glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, 1);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE);
	glDisable(GL_DEPTH_TEST);
	glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, fade);
	glPointSize(24);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-1.6, 1.6, -1.2, 1.2, 1, 10);
	glBegin(GL_POINTS);
	for (int i = 0; i < 35; i++) {
		glColor4f(1, 0.2f * (float)(i % 5), 0.1f * (float)(i % 7), 0.8f);
		glVertex3f(0.97f * (float)(i % 7 - 3), 0.93f * (float)(i / 7 - 2), -2 - 0.03f * (float)i);
	}
	glEnd();
	glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, whole);
	glDisable(GL_POINT_SPRITE);
	glDisable(GL_TEXTURE_2D);
	glDisable(GL_BLEND);
}

/* A Bezier surface, lit with generated normals, and its net (GL 2.1 sec. 5.1). */
static void evaluated(void)
{
	static const float where[4] = { 0.4f, 0.5f, 1, 0 };
	float points[4][5][3];

	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 5; j++) {
			points[i][j][0] = 0.4f * (float)i - 0.6f;
			points[i][j][1] = 0.25f * (float)j - 0.5f;
			points[i][j][2] = (float)((i * 7 + j * 3) % 5) * 0.3f - 0.6f;
		}
	glTranslatef(0, 0, -2.5f);
	glRotatef(25, 1, 0.4f, 0);
	glMap2f(GL_MAP2_VERTEX_3, 0, 1, 15, 4, 0, 1, 3, 5, &points[0][0][0]);
	glMapGrid2f(9, 0, 1, 7, 0, 1);
	glEnable(GL_MAP2_VERTEX_3);
	glEnable(GL_AUTO_NORMAL);
	glEnable(GL_NORMALIZE);
	glEnable(GL_LIGHTING);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
	glLightfv(GL_LIGHT0, GL_POSITION, where);
	glEvalMesh2(GL_FILL, 0, 9, 0, 7);
	glDisable(GL_LIGHTING);
	glTranslatef(0, 0.3f, 0.2f);
	glColor3f(0.6f, 0.8f, 0.2f);
	glEvalMesh2(GL_LINE, 0, 9, 0, 7);
}

/* Smooth, non-planar quads in view, which show how they are split. Vertices of an incomplete quad, far out of view,
 * have no effect. */
static void incomplete_quads(void)
{
	float position[7][3], color[7][3];

	for (int row = 0; row < 6; row++) {
		for (int i = 0; i < 7; i++) {
			position[i][0] = 0.35f * (float)(i == 1 || i == 2) - 0.4f + (i < 4 ? 0 : 90);
			position[i][1] = 0.15f * (float)(i >= 2) + 0.17f * (float)row - 0.5f;
			position[i][2] = i & 1 ? -2.4f : -2;
			for (int c = 0; c < 3; c++)
				color[i][c] = (float)((i * 3 + c * 5 + row) % 4) / 3;
		}
		if (row & 1) {
			glVertexPointer(3, GL_FLOAT, 0, position);
			glColorPointer(3, GL_FLOAT, 0, color);
			glEnableClientState(GL_VERTEX_ARRAY);
			glEnableClientState(GL_COLOR_ARRAY);
			glDrawArrays(GL_QUADS, 0, 4 + row / 2);
			glDisableClientState(GL_VERTEX_ARRAY);
			glDisableClientState(GL_COLOR_ARRAY);
			continue;
		}
		glBegin(GL_QUADS);
		for (int i = 0; i < 5 + row / 2; i++) {
			glColor3fv(color[i]);
			glVertex3fv(position[i]);
		}
		glEnd();
	}
}

int main(void)
{
	static void (*const frames[])(void) = { spokes, net, smooth_net, smooth_dots, coplanar, materials, points, evaluated,
		                                       incomplete_quads, far_sprites };

	open_window();
	for (unsigned i = 0; i < sizeof(frames) / sizeof(frames[0]); i++) {
		reset();
		frames[i]();
		end_frame();
	}
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
