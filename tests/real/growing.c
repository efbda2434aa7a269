/* A window that grows, shrinks and grows between frames, each drawn whole at the size that it has then. Recorded by test_record_growing.py. */
#include "tests/trace/window.h"

static void draw(int width, int height)
{
	glViewport(0, 0, width, height);
	glClear(GL_COLOR_BUFFER_BIT);
	glColor3f(1, 0.5f, 0);
	glRectf(-0.9f, -0.9f, 0.9f, 0.9f);
	end_frame();
}

int main(void)
{
	static const int sizes[][2] = { { 64, 48 }, { 100, 80 }, { 100, 80 }, { 60, 70 }, { 100, 80 }, { 64, 120 } };

	open_window();
	glClearColor(0, 0.3f, 0.6f, 1);
	for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
		XResizeWindow(display, window, (unsigned)sizes[i][0], (unsigned)sizes[i][1]);
		XSync(display, False);
		draw(sizes[i][0], sizes[i][1]);
	}
	return 0;
}
