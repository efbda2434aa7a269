/*
 * A static bowl of 3200 triangles and an animated one, the same in all three frames; rtBuildKdTreeEXT is called in the
 * second. Recorded by test_kdtree.py.
 */
#include <math.h>

#include "capture/relume.h"
#include "tests/trace/window.h"

#define SIDE 40

static void vertex(int i, int k, float depth)
{
	const float x = (float)i / SIDE * 2 - 1, y = (float)k / SIDE * 2 - 1;

	glColor3f(0.5f + 0.5f * x, 0.5f + 0.5f * y, 0.5f);
	glVertex3f(x, y, depth * (x * x + y * y));
}

static void bowl(float depth)
{
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < SIDE; i++)
		for (int k = 0; k < SIDE; k++) {
			vertex(i, k, depth), vertex(i + 1, k, depth), vertex(i + 1, k + 1, depth);
			vertex(i, k, depth), vertex(i + 1, k + 1, depth), vertex(i, k + 1, depth);
		}
	glEnd();
}

int main(void)
{
	open_window();

	glMatrixMode(GL_PROJECTION);
	glOrtho(-3, 3, -1.5, 1.5, -10, 10);
	glMatrixMode(GL_MODELVIEW);
	glEnable(GL_DEPTH_TEST);
	for (int frame = 0; frame < 4; frame++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glLoadIdentity();
		glTranslatef(-1.2f, 0, 0);
		bowl(0.5f);
		if (frame == 1)
			rtBuildKdTreeEXT();
		glTranslatef(2.4f, 0, 0);
		bowl(1 + 0.1f * (float)frame);
		end_frame();
	}
	return 0;
}
