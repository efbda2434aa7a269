/* Two frames with the read drawable set to another, smaller window, and two with one window for both reading and
 * drawing. Recorded by test_record_elsewhere.py. */
#include "tests/trace/window.h"

static void draw(void)
{
	glClear(GL_COLOR_BUFFER_BIT);
	glRectf(-0.5f, -0.5f, 0.9f, 0.9f);
	end_frame();
}

int main(void)
{
	Window drawn, small;
	GLXContext context;

	open_window();
	drawn = window;
	context = glXGetCurrentContext();
	window_size[0] = window_size[1] = 16;
	open_window();
	small = window;
	window = drawn;
	if (!glXMakeContextCurrent(display, drawn, small, context))
		return 77;
	glClearColor(0.2f, 0.4f, 0, 1);
	draw();
	draw();
	if (!glXMakeCurrent(display, drawn, context))
		return 1;
	draw();
	draw();
	return 0;
}
