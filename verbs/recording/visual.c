/*
 * Runs inside glretrace, before libGL. glretrace chooses its own visual (24 bits of depth, 8 of stencil and alpha)
 * whatever the program used. If surfaces are close together, a different depth precision shows a different surface.
 * RELUME_VISUAL="ALPHA DEPTH STENCIL SAMPLES", as in a trace's relume:bits marker, gives it configurations with exactly
 * these bits, if there are any.
 *
 * For a multisampled window it reads the mean of the samples, which is what the window shows; glReadPixels need not
 * return that (capture/gl/reference.c).
 */
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
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
	             (int[]){
		GLX_RENDER_TYPE, GLX_RGBA_BIT, GLX_DRAWABLE_TYPE, GLX_WINDOW_BIT, GLX_X_RENDERABLE, True, GLX_DOUBLEBUFFER,
		True, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, GLX_ALPHA_SIZE, alpha, GLX_DEPTH_SIZE, depth,
		GLX_STENCIL_SIZE, stencil, GLX_SAMPLES, samples, None
	},
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

static int get(GLenum what)
{
	int value = 0;

	glGetIntegerv(what, &value);
	return value;
}

void glReadPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, void *pixels)
{
	void (*read)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void *) =
		(void (*)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void *))dlsym(RTLD_NEXT, "glReadPixels");
	int draw = get(GL_DRAW_FRAMEBUFFER_BINDING), renderbuffer = get(GL_RENDERBUFFER_BINDING), scissor;
	GLuint framebuffer = 0, colors = 0;

	if (get(GL_READ_FRAMEBUFFER_BINDING) || draw || get(GL_SAMPLES) < 2 || format == GL_DEPTH_COMPONENT ||
	    format == GL_STENCIL_INDEX || format == GL_DEPTH_STENCIL) {
		read(x, y, width, height, format, type, pixels);
		return;
	}
	scissor = glIsEnabled(GL_SCISSOR_TEST);
	glDisable(GL_SCISSOR_TEST);
	glGenFramebuffers(1, &framebuffer);
	glGenRenderbuffers(1, &colors);
	glBindRenderbuffer(GL_RENDERBUFFER, colors);
	glRenderbufferStorage(GL_RENDERBUFFER, get(GL_ALPHA_BITS) > 0 ? GL_RGBA8 : GL_RGB8, width, height);
	glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
	glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colors);
	glBlitFramebuffer(x, y, x + width, y + height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
	glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
	read(0, 0, width, height, format, type, pixels);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glBindRenderbuffer(GL_RENDERBUFFER, (GLuint)renderbuffer);
	glDeleteFramebuffers(1, &framebuffer);
	glDeleteRenderbuffers(1, &colors);
	if (scissor)
		glEnable(GL_SCISSOR_TEST);
}
