/*
 * A program that is hard on recorders. After its third frame it closes all regular files except the standard
 * descriptors, and opens a file of its own for each number that became free. Run by test_record_durable.sh.
 */
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

/* Close regular files that others opened. Other descriptors stay open, because the GL library needs its own. */
static void close_files(void)
{
	for (int fd = 3; fd < 1024; fd++) {
		struct stat st;

		if (fstat(fd, &st) == 0 && S_ISREG(st.st_mode))
			close(fd);
	}
}

static void take_numbers(void)
{
	char path[4096];
	int victim;

	snprintf(path, sizeof(path), "%s/victim", getenv("TMPDIR"));
	victim = open(path, O_RDWR | O_CREAT | O_TRUNC, 0666);
	if (victim < 0 || write(victim, "victim", 6) != 6)
		exit(1);
	for (int fd = 3; fd < 512; fd++)
		if (fcntl(fd, F_GETFD) < 0)
			dup2(victim, fd);
}

int main(void)
{
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 1, None };
	Display *display = XOpenDisplay(NULL);
	XSetWindowAttributes set = { 0 };
	XVisualInfo *visual;
	GLXContext context;
	Window window;

	if (!display || !(visual = glXChooseVisual(display, DefaultScreen(display), attributes)))
		return 1;
	set.colormap = XCreateColormap(display, DefaultRootWindow(display), visual->visual, AllocNone);
	window = XCreateWindow(display, DefaultRootWindow(display), 0, 0, 64, 64, 0, visual->depth, InputOutput,
	                       visual->visual, CWColormap, &set);
	context = glXCreateContext(display, visual, NULL, True);
	XMapWindow(display, window);
	glXMakeCurrent(display, window, context);
	for (int frame = 0; frame < 1000; frame++) {
		glClearColor((float)(frame % 10) / 10.0f, 0.0f, 0.0f, 1.0f);
		glClear(GL_COLOR_BUFFER_BIT);
		glXSwapBuffers(display, window);
		if (frame == 3) {
			close_files();
			take_numbers();
		}
	}
	return 0;
}
