/*
 * Windows whose size no viewport reveals: the viewport comes late, covers only a part or never comes; and the context
 * moves to another window. Recorded by test_small.py.
 */
#include "tests/trace/window.h"

static void resize(unsigned width, unsigned height)
{
	XResizeWindow(display, window, width, height);
	XSync(display, False);
}

static void clear(float red)
{
	glClearColor(red, 0.2f, 0.4f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static void clear_parts(void)
{
	glEnable(GL_SCISSOR_TEST);
	for (int i = 0; i < 4; i++) {
		glScissor(30 * i, 20 * i, 28, 18);
		clear(0.25f * (float)i);
	}
	glDisable(GL_SCISSOR_TEST);
}

static void draw_pixels(void)
{
	static GLubyte pixels[20 * 20 * 4];

	for (unsigned i = 0; i < sizeof(pixels); i++)
		pixels[i] = (GLubyte)(i * 31 % 256);
	glWindowPos2i(90, 60);
	glDrawPixels(20, 20, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}

static void quarter_views(int width, int height)
{
	for (int i = 0; i < 4; i++) {
		glViewport(i % 2 * width / 2, i / 2 * height / 2, width / 2, height / 2);
		glColor3f((float)(i % 2), 0.5f, (float)(i / 2));
		glRectf(-0.7f, -0.7f, 0.7f, 0.7f);
	}
}

static void go_to_another_window(void)
{
	XSetWindowAttributes set = { 0 };
	XWindowAttributes was;

	XGetWindowAttributes(display, window, &was);
	set.colormap = was.colormap;
	window = XCreateWindow(display, DefaultRootWindow(display), 0, 0, 150, 70, 0, was.depth, InputOutput,
	                       was.visual, CWColormap, &set);
	XMapWindow(display, window);
	glXMakeCurrent(display, window, glXGetCurrentContext());
}

int main(void)
{
	open_window();
	clear(0.5f);
	end_frame();
	resize(120, 90); /* no viewport */
	clear(0.8f);
	glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
	end_frame();
	resize(140, 100); /* only scissored clears */
	clear_parts();
	end_frame();
	resize(160, 110); /* only pixel rectangles */
	draw_pixels();
	end_frame();
	resize(200, 120); /* viewports for parts, after the clear */
	clear(0.1f);
	quarter_views(200, 120);
	end_frame();
	resize(80, 60);
	clear(0.6f);
	quarter_views(80, 60);
	end_frame();
	go_to_another_window();
	clear(0.3f);
	glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
	end_frame();
	resize(64, 64);
	clear_parts();
	end_frame();
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
