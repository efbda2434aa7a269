/*
 * A window with OpenGL ES 1 on X11, and the frame loop of the programs in this folder. `--frames N` ends after N
 * frames; every run draws the same pictures.
 */
#pragma once

#include <EGL/egl.h>
#include <GLES/gl.h>
#include <GLES/glext.h>
#include <X11/Xlib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 400, HEIGHT = 300 };

/* Each program defines these: state once, then a picture for each frame number. */
static void set_up(void);
static void draw_frame(int frame);

static void fail(const char *what)
{
	fprintf(stderr, "no %s\n", what);
	exit(1);
}

/* Not the program's fault: Mesa may be built without OpenGL ES 1. */
static void lack(void)
{
	fprintf(stderr, "skipped: no OpenGL ES 1 context here\n");
	exit(77);
}

int main(int argc, char **argv)
{
	const EGLint config_attributes[] = {
		EGL_SURFACE_TYPE, EGL_WINDOW_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES_BIT, EGL_RED_SIZE, 8, EGL_DEPTH_SIZE, 24,
		EGL_STENCIL_SIZE, 8, EGL_NONE
	};
	const EGLint context_attributes[] = { EGL_CONTEXT_CLIENT_VERSION, 1, EGL_NONE };
	const int frames = argc > 2 && strcmp(argv[1], "--frames") == 0 ? atoi(argv[2]) : 10;
	Display *display = XOpenDisplay(NULL);
	EGLDisplay egl;
	EGLContext context;
	EGLSurface surface;
	EGLConfig config;
	EGLint n = 0;
	Window window;

	if (!display)
		fail("display");
	egl = eglGetDisplay((EGLNativeDisplayType)display);
	if (!eglInitialize(egl, NULL, NULL) || !eglBindAPI(EGL_OPENGL_ES_API) ||
	    !eglChooseConfig(egl, config_attributes, &config, 1, &n) || !n)
		lack();
	window = XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, WIDTH, HEIGHT, 0, 0, 0);
	XMapWindow(display, window);
	XSync(display, False);
	context = eglCreateContext(egl, config, EGL_NO_CONTEXT, context_attributes);
	surface = eglCreateWindowSurface(egl, config, (EGLNativeWindowType)window, NULL);
	if (!context)
		lack();
	if (!surface || !eglMakeCurrent(egl, surface, surface, context))
		fail("surface");
	set_up();
	for (int frame = 0; frame < frames; frame++) {
		draw_frame(frame);
		if (glGetError())
			fail("frame without an error");
		eglSwapBuffers(egl, surface);
	}
	eglTerminate(egl);
	XCloseDisplay(display);
	return 0;
}
