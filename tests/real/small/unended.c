/*
 * Frames that end when reading pixels is not allowed: between glBegin and glEnd, and while a list is compiled. Recorded
 * by test_small.py.
 */
#include "tests/trace/window.h"

static void before(void)
{
	glClear(GL_COLOR_BUFFER_BIT);
	glColor3f(0.2f, 0.6f, 1);
}

static void half_a_triangle(void)
{
	glBegin(GL_TRIANGLES);
	glVertex2f(-0.5f, -0.5f);
	glVertex2f(0.5f, -0.5f);
}

static void ended(void)
{
	glVertex2f(0, 0.5f);
	glEnd();
	before();
	glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
}

static void half_a_list(void)
{
	glRectf(-0.25f, -0.5f, 0.5f, 0.5f);
	glNewList(1, GL_COMPILE);
	glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
}

static void listed(void)
{
	glEndList();
	before();
	glCallList(1);
}

int main(void)
{
	static void (*const frames[])(void) = { half_a_triangle, ended, half_a_list, listed };

	open_window();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), before);
	return 0;
}
