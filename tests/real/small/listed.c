/*
 * A display list that is compiled before its window grows: the window's size is not part of the list. A frame each;
 * recorded by test_small.py.
 */
#include "tests/trace/window.h"

static void compile(GLenum mode)
{
	glNewList(2, mode);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glColor3f(1, 0, 0);
	glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
	glEndList();
}

static void resize(unsigned width, unsigned height)
{
	XWindowAttributes now;

	XResizeWindow(display, window, width, height);
	do
		XGetWindowAttributes(display, window, &now);
	while (now.width != (int)width);
	glViewport(0, 0, (GLsizei)width, (GLsizei)height);
}

int main(void)
{
	window_size[0] = window_size[1] = 8;
	open_window();
	glClearColor(0.2f, 0.4f, 0.6f, 1);
	compile(GL_COMPILE);
	glCallList(2);
	end_frame();
	resize(64, 48);
	glCallList(2);
	end_frame();
	compile(GL_COMPILE_AND_EXECUTE);
	end_frame();
	resize(80, 60);
	glCallList(2);
	end_frame();
	return 0;
}
