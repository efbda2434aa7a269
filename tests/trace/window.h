/* A GLX window for the small programs in this folder, 64 x 48 pixels unless a program sets another size before
 * opening it. */
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static Display *display;
static Window window;
static unsigned window_size[2] = { 64, 48 };
static const char *window_kind = "a plain one"; /* a property that some GLs lack: Mesa 25 has neither samples nor
                                                   accumulation buffers */

static inline void open_window_of(int *attributes)
{
	XSetWindowAttributes set = { 0 };
	XVisualInfo *visual;

	display = XOpenDisplay(NULL);
	if (!display)
		exit(1);
	visual = glXChooseVisual(display, DefaultScreen(display), attributes);
	if (!visual) {
		fprintf(stderr, "skipped: this GL has no such window: %s\n", window_kind);
		exit(77);
	}
	set.colormap = XCreateColormap(display, DefaultRootWindow(display), visual->visual, AllocNone);
	window = XCreateWindow(display, DefaultRootWindow(display), 0, 0, window_size[0], window_size[1], 0,
	                       visual->depth, InputOutput, visual->visual, CWColormap, &set);
	XMapWindow(display, window);
	if (!glXMakeCurrent(display, window, glXCreateContext(display, visual, NULL, True)))
		exit(1);
}

static inline void open_window(void)
{
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 1, GLX_STENCIL_SIZE, 1, None };

	open_window_of(attributes);
}

/** A window of that size, with depth test and one light. */
static inline void open_lit_window(unsigned width, unsigned height)
{
	window_size[0] = width;
	window_size[1] = height;
	open_window();
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
}

static inline void end_frame(void)
{
	glXSwapBuffers(display, window);
}

/** An empty window, seen through a frustum; eye space is object space. */
static inline void begin_view(void)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.2, 0.2, -0.15, 0.15, 0.2, 30);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
}

/** An empty window where object space is pixels, and the colour is white. */
static inline void begin_pixels(void)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, window_size[0], 0, window_size[1], -1, 1);
	glMatrixMode(GL_MODELVIEW);
	glColor4f(1, 1, 1, 1);
}

/** One function per frame, each after `before`. */
static inline void draw_frames(void (*const *frames)(void), size_t n, void (*before)(void))
{
	for (size_t i = 0; i < n; i++) {
		before();
		frames[i]();
		end_frame();
	}
}

/** The program's own check that it was not disturbed. */
static inline void expect(int truth, const char *what)
{
	if (!truth) {
		fprintf(stderr, "not so: %s\n", what);
		exit(1);
	}
}
