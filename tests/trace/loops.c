/* Quads and line loops that repeat themselves from frame to frame, which drivers' lists may draw otherwise than immediate mode. */
#include "window.h"

enum { FRAMES = 6, CORNERS = 12 };

static void run(GLenum mode, float size)
{
	static const float x[4] = { -1, 1, 1, -1 }, y[4] = { -1, -1, 1, 1 };

	glBegin(mode);
	for (int i = 0; i < CORNERS; i++) {
		float shrink = size * (1 - 0.25f * (float)(i / 4));

		glColor3f((float)i / CORNERS, x[i % 4], y[i % 4]);
		glVertex3f(shrink * x[i % 4], shrink * y[i % 4], -0.1f * (float)i);
	}
	glEnd();
}

int main(void)
{
	open_window();
	glMatrixMode(GL_PROJECTION);
	glFrustum(-0.5, 0.5, -0.4, 0.4, 1, 10);
	glMatrixMode(GL_MODELVIEW);
	glEnable(GL_DEPTH_TEST);
	for (int frame = 0; frame < FRAMES; frame++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glLoadIdentity();
		glTranslatef(0, 0, -3);
		glRotatef(10.0f * (float)frame, 1, 1, 0);
		run(GL_QUADS, 1);
		run(GL_LINE_LOOP, 1.2f);
		end_frame();
	}
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
