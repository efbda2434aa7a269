/*
 * Features measured in pixels, in a window of 96x72 times the first argument: lines, stippled lines, points that shrink
 * with distance, a decal with polygon offset, clears and draws under a scissor, zoomed pixels. Recorded by
 * test_scale.py, which compares the sizes.
 */
#include <stdlib.h>

#include "tests/trace/window.h"

static int times; /* scale relative to 96x72 */

static void lines(void)
{
	glColor3f(1, 0.5f, 0);
	glLineWidth(3.0f * (float)times);
	glBegin(GL_LINES);
	glVertex3f(-1.5f, 1, -4);
	glVertex3f(1.25f, 1.25f, -4);
	glEnd();
	glLineWidth((float)times);
	glEnable(GL_LINE_STIPPLE);
	glLineStipple(2 * times, 0x3f07);
	glBegin(GL_LINES);
	glVertex3f(-1.5f, 0.75f, -4);
	glVertex3f(1.5f, 0.75f, -4);
	glEnd();
	glDisable(GL_LINE_STIPPLE);
}

static void points(void)
{
	static const float quadratic[3] = { 0, 0, 0.0625f };

	glColor3f(0, 0.75f, 1);
	glPointSize(6.0f * (float)times);
	glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, quadratic);
	glPointParameterf(GL_POINT_SIZE_MAX, 20.0f * (float)times);
	glBegin(GL_POINTS);
	for (int i = 0; i < 4; i++)
		glVertex3f(-1.0f + 0.625f * (float)i, -1.125f, -4 - 0.5f * (float)i);
	glEnd();
}

/* A steep floor, and a coplanar decal that polygon offset moves in front of it. */
static void decal(void)
{
	for (int i = 0; i < 2; i++) {
		const float near = i ? 0.5f : 1;

		glColor3f(i ? 0.75f : 0.25f, 0.25f, 0.25f);
		if (i)
			glEnable(GL_POLYGON_OFFSET_FILL);
		glPolygonOffset(-1, -1);
		glBegin(GL_QUADS);
		glVertex3f(-near, -0.75f, -3);
		glVertex3f(near, -0.75f, -3);
		glVertex3f(near, 0, -9);
		glVertex3f(-near, 0, -9);
		glEnd();
		glDisable(GL_POLYGON_OFFSET_FILL);
	}
}

static void part(void)
{
	glEnable(GL_SCISSOR_TEST);
	glScissor(70 * times, 40 * times, 20 * times, 25 * times);
	glClearColor(0.25f, 0.5f, 0.25f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glColor3f(1, 1, 0);
	glBegin(GL_TRIANGLES);
	glVertex3f(0, 0, -4);
	glVertex3f(4, 0, -4);
	glVertex3f(1, 3, -4);
	glEnd();
	glDisable(GL_SCISSOR_TEST);
}

static void pixels(void)
{
	static const GLubyte picture[4][4] = { { 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 },
		                               { 255, 255, 255, 255 } };

	glPixelZoom(3.0f * (float)times, 2.0f * (float)times);
	glWindowPos2i(5 * times, 50 * times);
	glDrawPixels(2, 2, GL_RGBA, GL_UNSIGNED_BYTE, picture);
}

int main(int argc, char **argv)
{
	times = argc > 1 ? atoi(argv[1]) : 1;
	window_size[0] = 96 * times;
	window_size[1] = 72 * times;
	open_window();
	glEnable(GL_DEPTH_TEST);
	glMatrixMode(GL_PROJECTION);
	glFrustum(-0.5, 0.5, -0.375, 0.375, 1, 20);
	glMatrixMode(GL_MODELVIEW);
	for (int frame = 0; frame < 2; frame++) {
		glClearColor(0, 0, 0.25f, 1);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		lines();
		points();
		decal();
		part();
		pixels();
		glTranslatef(0.125f, 0, -0.25f);
		end_frame();
	}
	return 0;
}
