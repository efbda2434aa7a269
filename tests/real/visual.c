/*
 * Stands before libGL for glretrace, which takes a visual of its own choice (24 bits of depth, 8 of stencil and alpha) whatever the
 * program had: where surfaces lie close together another precision shows another one. With RELUME_VISUAL="ALPHA DEPTH STENCIL
 * SAMPLES", as a trace's relume:bits marker has them, it gets configurations with just these bits, or its own where there is none.
 */
#include <GL/glx.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

static int attribute(Display *display, GLXFBConfig config, int name)
{
	int value = -1;

	return glXGetFBConfigAttrib(display, config, name, &value) == 0 ? value : -1;
}

GLXFBConfig *glXChooseFBConfig(Display *display, int screen, const int *wanted, int *n)
{
	GLXFBConfig *(*choose)(Display *, int, const int *, int *) =
		(GLXFBConfig * (*)(Display *, int, const int *, int *)) dlsym(RTLD_NEXT, "glXChooseFBConfig");
	const char *text = getenv("RELUME_VISUAL");
	int alpha, depth, stencil, samples, n_all = 0, good = 0;
	GLXFBConfig *all;

	if (!text || sscanf(text, "%d %d %d %d", &alpha, &depth, &stencil, &samples) != 4)
		return choose(display, screen, wanted, n);
	all = choose(display, screen,
	             (int[]){ GLX_RENDER_TYPE, GLX_RGBA_BIT, GLX_DRAWABLE_TYPE, GLX_WINDOW_BIT, GLX_X_RENDERABLE, True, GLX_DOUBLEBUFFER,
	                      True, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, GLX_ALPHA_SIZE, alpha, GLX_DEPTH_SIZE, depth,
	                      GLX_STENCIL_SIZE, stencil, GLX_SAMPLES, samples, None },
	             &n_all);
	for (int i = 0; i < n_all; i++)
		if (attribute(display, all[i], GLX_ALPHA_SIZE) == alpha && attribute(display, all[i], GLX_DEPTH_SIZE) == depth &&
		    attribute(display, all[i], GLX_STENCIL_SIZE) == stencil && attribute(display, all[i], GLX_SAMPLES) == samples)
			all[good++] = all[i];
	if (!good)
		return choose(display, screen, wanted, n);
	*n = good;
	return all;
}
