/*
 * Smooth hills and valleys in a window with several samples per pixel, lit from the viewer's place: nothing that is
 * visible can be in shadow. Recorded by test_small.py.
 */
#include "tests/trace/window.h"

#include <math.h>

static double height(double x, double y)
{
	return 0.2 * sin(4 * x + 2 * y) * cos(5 * y - x) + 0.05 * sin(23 * x) * sin(19 * y);
}

static void corner(int column, int row)
{
	const double x = column / 8.0 + 0.04 * (row % 3), y = row / 8.0 + 0.03 * (column % 4), step = 1 / 8.0;

	glNormal3d((height(x - step, y) - height(x + step, y)) / (2 * step),
	           (height(x, y - step) - height(x, y + step)) / (2 * step), 1);
	glVertex3d(x, y, height(x, y));
}

int main(void)
{
	static const GLfloat from[] = { 0, 0, 1, 0 };
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 1, GLX_SAMPLE_BUFFERS, 1, GLX_SAMPLES, 4, None };

	window_size[0] = window_size[1] = 200;
	window_kind = "samples";
	open_window_of(attributes);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_NORMALIZE);
	glLightfv(GL_LIGHT0, GL_POSITION, from);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	for (int row = -8; row < 8; row++) {
		glBegin(GL_TRIANGLE_STRIP);
		for (int column = -8; column <= 8; column++) {
			corner(column, row + 1);
			corner(column, row);
		}
		glEnd();
	}
	end_frame();
	return 0;
}
