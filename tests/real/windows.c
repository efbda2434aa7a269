/*
 * Two windows of different sizes and colours, to which one context draws in turn. With an argument a program is current. Recorded by
 * test_windows.py.
 */
#include "tests/trace/window.h"

#define FRAMES 5

static XVisualInfo *visual;

static Window make_window(Display *on, unsigned size)
{
	XSetWindowAttributes set = { 0 };
	Window made;

	set.colormap = XCreateColormap(on, DefaultRootWindow(on), visual->visual, AllocNone);
	made = XCreateWindow(on, DefaultRootWindow(on), 0, 0, size, size, 0, visual->depth, InputOutput, visual->visual, CWColormap, &set);
	XMapWindow(on, made);
	XSync(on, False);
	return made;
}

static void draw(int which, int frame, unsigned size)
{
	glViewport(0, 0, (int)size, (int)size);
	glEnable(GL_DEPTH_TEST);
	glClearColor(which ? 0.6f : 0.1f, 0.1f * (float)frame, which ? 0.1f : 0.6f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glColor3f(1, 0.2f * (float)frame, (float)which);
	glRectf(-0.5f, -0.5f, 0.1f * (float)frame, which ? 0.2f : 0.7f);
}

static void both_from_one(int shaders)
{
	Window windows[2];
	GLXContext context;

	windows[0] = make_window(display, 48);
	windows[1] = make_window(display, 80);
	context = glXCreateContext(display, visual, NULL, True);
	for (int frame = 0; frame < FRAMES; frame++)
		for (int i = 0; i < 2; i++) {
			glXMakeCurrent(display, windows[i], context);
			if (shaders && !frame && !i)
				glUseProgram(glCreateProgram());
			draw(i, frame, i ? 80 : 48);
			glXSwapBuffers(display, windows[i]);
		}
}

int main(int argc, char **argv)
{
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 1, None };

	display = XOpenDisplay(NULL);
	(void)argv;
	if (!display || !(visual = glXChooseVisual(display, DefaultScreen(display), attributes)))
		return 1;
	both_from_one(argc > 1);
	return 0;
}
