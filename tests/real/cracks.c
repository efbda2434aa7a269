/*
 * A room without windows, seen from inside, and a lamp above its roof. Frame 0: the roof's halves meet in a T-junction
 * whose corner is not exactly on the edge, so that light leaks through. Frame 1: a die between the viewer and bright
 * stripes; its faces that are turned away from the viewer have reversed winding. Frame 2: the same die with correct
 * winding. Frame 3: all its faces reversed. Recorded by test_cracks.py.
 */
#include "tests/trace/window.h"

#define W 4.0f
#define H 3.0f

static void quad(const float normal[3], const float a[3], const float b[3], const float c[3], const float d[3])
{
	glNormal3fv(normal);
	glVertex3fv(a);
	glVertex3fv(b);
	glVertex3fv(c);
	glVertex3fv(d);
}

static void draw_room(void)
{
	static const float at[8][3] = { { -W, 0, -W }, { W, 0, -W }, { W, 0, W }, { -W, 0, W },
		                        { -W, H, -W }, { W, H, -W }, { W, H, W }, { -W, H, W } };
	static const float left[3] = { -W, H, -2 }, right[3] = { W, H, 2 }, corner[3] = { 1, H, 0.55f }, end[3] = { 1, H, W };
	static const float up[3] = { 0, 1, 0 }, down[3] = { 0, -1, 0 }, east[3] = { 1, 0, 0 }, west[3] = { -1, 0, 0 },
			   north[3] = { 0, 0, -1 }, south[3] = { 0, 0, 1 };

	glBegin(GL_QUADS);
	quad(up, at[0], at[3], at[2], at[1]);
	quad(south, at[0], at[1], at[5], at[4]);
	quad(north, at[2], at[3], at[7], at[6]);
	quad(east, at[3], at[0], at[4], at[7]);
	quad(west, at[1], at[2], at[6], at[5]);
	quad(down, at[4], at[5], right, left);
	quad(down, left, corner, end, at[7]);
	quad(down, corner, right, at[6], end);
	glEnd();
}

static void draw_stripes(void)
{
	glBegin(GL_QUADS);
	for (int i = -12; i < 12; i++) {
		glColor3f(i & 1 ? 1 : 0, 0.1f * (float)(i & 7), i & 2 ? 0.8f : 0);
		glVertex3f(0.5f * (float)i, -6, -5);
		glVertex3f(0.5f * (float)(i + 1), -6, -5);
		glVertex3f(0.5f * (float)(i + 1), 6, -5);
		glVertex3f(0.5f * (float)i, 6, -5);
	}
	glEnd();
}

/* Sides 1, 2 and 5 face away from the viewer. turned: a bit for each side with clockwise winding */
static void draw_die(unsigned turned)
{
	static const int sides[6][4] = { { 4, 5, 7, 6 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
		                         { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 0, 2, 3, 1 } };

	glNewList(1, GL_COMPILE);
	glBegin(GL_QUADS);
	for (int i = 0; i < 6; i++)
		for (int k = 0; k < 4; k++) {
			const int c = sides[i][turned >> i & 1 ? 3 - k : k];

			glVertex3f(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
		}
	glEnd();
	glEndList();
	glColor3f(1, 1, 1);
	glTranslatef(0, 0, -1);
	glRotatef(20, 1, 0, 0);
	glRotatef(30, 0, 1, 0);
	glCallList(1);
}

int main(void)
{
	static const float lamp[4] = { 0.3f, 30, 0.2f, 1 };
	static const unsigned turned[4] = { 0, 1 << 1 | 1 << 2 | 1 << 5, 0, 63 };

	window_size[0] = 160;
	window_size[1] = 120;
	open_window();
	glEnable(GL_DEPTH_TEST);
	glMatrixMode(GL_PROJECTION);
	glFrustum(-0.4, 0.4, -0.3, 0.3, 0.5, 50);
	glMatrixMode(GL_MODELVIEW);
	for (int frame = 0; frame < 4; frame++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glLoadIdentity();
		if (frame == 0) {
			glEnable(GL_LIGHTING);
			glEnable(GL_LIGHT0);
			glTranslatef(0, -1.5f, -3.5f);
			glLightfv(GL_LIGHT0, GL_POSITION, lamp);
			draw_room();
			glDisable(GL_LIGHTING);
		} else {
			glTranslatef(0, 0, -3);
			draw_stripes();
			draw_die(turned[frame]);
		}
		end_frame();
	}
	return 0;
}
