/*
 * Depth buffers that a frame does not clear: neither cleared nor used; compared with the initial depth; written; kept
 * by a frame that does not use depth; and cleared. Recorded by test_depths.py.
 */
#include "tests/trace/window.h"

static void triangle(float far)
{
	glBegin(GL_TRIANGLES);
	glColor3f(1, 0, 0);
	glVertex3f(-0.5f, -0.5f, 0);
	glVertex3f(0.5f, -0.5f, 0);
	glColor3f(0, 1, far);
	glVertex3f(0, 0.5f, far);
	glEnd();
}

int main(void)
{
	open_window();
	for (int frame = 0; frame < 6; frame++) {
		glClear(GL_COLOR_BUFFER_BIT | (frame == 5 ? GL_DEPTH_BUFFER_BIT : 0));
		if (frame == 2 || frame == 3) {
			glEnable(GL_DEPTH_TEST);
			glDepthFunc(frame == 2 ? GL_GREATER : GL_LESS);
		} else {
			glDisable(GL_DEPTH_TEST);
		}
		triangle(frame == 3 ? -0.5f : 0.5f);
		end_frame();
	}
	return 0;
}
