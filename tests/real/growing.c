/* A window that grows, shrinks and grows again, between frames and once within a frame. Each frame fills the window
 * at its current size. Recorded by test_record_growing.py. */
#include "tests/trace/window.h"

static void resize(int width, int height)
{
	XResizeWindow(display, window, (unsigned)width, (unsigned)height);
	XSync(display, False);
}

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
		resize(sizes[i][0], sizes[i][1]);
		draw(sizes[i][0], sizes[i][1]);
	}
	glClear(GL_COLOR_BUFFER_BIT); /* this makes Mesa use the window's old size for this frame */
	resize(110, 140);
	draw(110, 140);
	draw(110, 140);
	return 0;
}
