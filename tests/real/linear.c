/*
 * Overlapping films in a window without depth, which Mesa's llvmpipe draws with its fast rasterizer. Recorded by
 * test_exact.py. With an argument the window is single-buffered.
 */
#include "tests/trace/window.h"

#define FILMS 6

int main(int argc, char **argv)
{
	int attributes[] = { GLX_RGBA, GLX_RED_SIZE, 8, argc > 1 ? None : GLX_DOUBLEBUFFER, None };

	(void)argv;
	window_size[0] = window_size[1] = 128;
	open_window_of(attributes);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (int frame = 0; frame < 3; frame++) {
		glClear(GL_COLOR_BUFFER_BIT);
		for (int i = 0; i < FILMS; i++) {
			const float edge = 0.9f - 0.1f * (float)i;

			glColor4f(0.7f, 0.1f * (float)i, 0.5f, 0.1f + 0.03f * (float)(i + frame));
			glRectf(-edge, -edge, edge, edge);
		}
		if (argc > 1)
			glFlush();
		else
			end_frame();
	}
	return 0;
}
