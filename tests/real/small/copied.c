/*
 * Pictures shown by glXCopySubBufferMESA, as compositors do: the back buffer stays, and the parts of one picture are
 * one frame. A frame each; recorded by test_small.py.
 */
#include "tests/trace/window.h"

static void draw(int i)
{
	glColor3f(0.2f + 0.1f * (float)i, 0.9f - 0.2f * (float)i, 0.3f);
	glRectf(-0.9f + 0.3f * (float)i, -0.8f, -0.5f + 0.3f * (float)i, 0.2f + 0.1f * (float)i);
}

int main(void)
{
	const PFNGLXCOPYSUBBUFFERMESAPROC copy =
		(PFNGLXCOPYSUBBUFFERMESAPROC)glXGetProcAddress((const GLubyte *)"glXCopySubBufferMESA");

	open_window();
	if (!strstr(glXQueryExtensionsString(display, DefaultScreen(display)), "GLX_MESA_copy_sub_buffer")) {
		fprintf(stderr, "skipped: this GL has no such window: GLX_MESA_copy_sub_buffer\n");
		return 77;
	}
	glClearColor(0.1f, 0.2f, 0.3f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	draw(0);
	end_frame();
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	draw(1);
	copy(display, window, 0, 0, 64, 48);
	glFinish();
	draw(2); /* over what is there */
	copy(display, window, 10, 5, 20, 30);
	glFinish();
	copy(display, window, 40, 5, 20, 30);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	draw(3);
	end_frame();
	return 0;
}
