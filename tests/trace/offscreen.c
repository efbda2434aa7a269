/*
 * Programs without a window: offscreen pbuffer|surfaceless|device|osmesa. A triangle on a coloured ground, a different
 * one in each of three frames; pbuffer ends its frames by eglSwapBuffers, the others by glFinish. Without a surface, a
 * framebuffer object is the target. The program reads back and checks the middle of each picture. Recorded by
 * test_record_offscreen.py; exits with 77 if the library or platform is missing.
 */
#include <GL/gl.h>
#include <GL/glext.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 32, FRAMES = 3 };
/* Constants newer than EGL/egl.h and EGL/eglext.h. */
enum {
	EGL_NONE_ = 0x3038, EGL_SURFACE_TYPE_ = 0x3033, EGL_PBUFFER_BIT_ = 1, EGL_RENDERABLE_TYPE_ = 0x3040,
	EGL_OPENGL_BIT_ = 8, EGL_DEPTH_SIZE_ = 0x3025, EGL_RED_SIZE_ = 0x3024, EGL_HEIGHT_ = 0x3056, EGL_WIDTH_ = 0x3057,
	EGL_OPENGL_API_ = 0x30A2, EGL_PLATFORM_SURFACELESS_ = 0x31DD, EGL_PLATFORM_DEVICE_ = 0x313F
};

static unsigned char osmesa_pixels[SIDE * SIDE * 4];
static void *egl_library, *display, *surface;

static void give_up(const char *what)
{
	fprintf(stderr, "there is no %s\n", what);
	exit(77);
}

static void *egl(const char *name)
{
	static void *(*get)(const char *);
	void *found = dlsym(egl_library, name);

	if (!get)
		get = (void *(*)(const char *))dlsym(egl_library, "eglGetProcAddress");
	if (!found)
		found = get(name);
	if (!found)
		give_up(name);
	return found;
}

#define EGL(result, name, ...) ((result(*)(__VA_ARGS__))egl(#name))

static void *open_display(const char *how)
{
	void *device = NULL;
	int n = 0;

	if (strcmp(how, "device") == 0) {
		if (!EGL(unsigned, eglQueryDevicesEXT, int, void **, int *)(1, &device, &n) || n < 1)
			give_up("EGL device");
		return EGL(void *, eglGetPlatformDisplayEXT, unsigned, void *, const int *)(EGL_PLATFORM_DEVICE_, device, NULL);
	}
	return EGL(void *, eglGetPlatformDisplayEXT, unsigned, void *, const int *)(EGL_PLATFORM_SURFACELESS_, NULL, NULL);
}

static void begin_egl(const char *how)
{
	const int wanted[] = { EGL_SURFACE_TYPE_, EGL_PBUFFER_BIT_, EGL_RENDERABLE_TYPE_, EGL_OPENGL_BIT_, EGL_RED_SIZE_, 8,
		               EGL_DEPTH_SIZE_,   16,               EGL_NONE_ };
	const int size[] = { EGL_WIDTH_, SIDE, EGL_HEIGHT_, SIDE, EGL_NONE_ };
	int major, minor, n = 0;
	void *config, *context;

	egl_library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
	if (!egl_library)
		give_up("libEGL");
	display = open_display(how);
	if (!display || !EGL(unsigned, eglInitialize, void *, int *, int *)(display, &major, &minor))
		give_up("display");
	if (!EGL(unsigned, eglBindAPI, unsigned)(EGL_OPENGL_API_) ||
	    !EGL(unsigned, eglChooseConfig, void *, const int *, void **, int, int *)(display, wanted, &config, 1,
	                                                                              &n) ||
	    n < 1)
		give_up("configuration");
	context = EGL(void *, eglCreateContext, void *, void *, void *, const int *)(display, config, NULL, NULL);
	if (strcmp(how, "pbuffer") == 0)
		surface = EGL(void *, eglCreatePbufferSurface, void *, void *, const int *)(display, config, size);
	if (!context || !EGL(unsigned, eglMakeCurrent, void *, void *, void *, void *)(display, surface, surface, context))
		give_up("context");
}

static void begin_osmesa(void)
{
	void *library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_GLOBAL), *context;

	if (!library)
		give_up("libOSMesa");
	context = ((void *(*)(unsigned, int, int, int, void *))dlsym(library, "OSMesaCreateContextExt"))(GL_RGBA, 24, 8,
	                                                                                                 0, NULL);
	if (!((unsigned char (*)(void *, void *, unsigned, int, int))dlsym(library, "OSMesaMakeCurrent"))(
		    context, osmesa_pixels, GL_UNSIGNED_BYTE, SIDE, SIDE))
		give_up("OSMesa context");
	egl_library = library; /* the library with its gl* functions */
}

#define GL(name, ...) ((void (*)(__VA_ARGS__))gl(#name))

static void *gl(const char *name)
{
	void *found = dlsym(egl_library, name);

	return found ? found : egl(name);
}

static void make_object(void)
{
	unsigned object, buffers[2];

	GL(glGenFramebuffers, int, unsigned *)(1, &object);
	GL(glGenRenderbuffers, int, unsigned *)(2, buffers);
	GL(glBindFramebuffer, unsigned, unsigned)(GL_FRAMEBUFFER, object);
	for (int i = 0; i < 2; i++) {
		GL(glBindRenderbuffer, unsigned, unsigned)(GL_RENDERBUFFER, buffers[i]);
		GL(glRenderbufferStorage, unsigned, unsigned, int, int)
		(GL_RENDERBUFFER, i ? GL_DEPTH_COMPONENT24 : GL_RGBA8, SIDE, SIDE);
		GL(glFramebufferRenderbuffer, unsigned, unsigned, unsigned, unsigned)(GL_FRAMEBUFFER,
		                                                                     i ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0,
		                                                                     GL_RENDERBUFFER, buffers[i]);
	}
	GL(glViewport, int, int, int, int)(0, 0, SIDE, SIDE);
}

static int draw(int frame)
{
	static const unsigned char want[FRAMES][3] = { { 255, 0, 0 }, { 0, 255, 0 }, { 0, 0, 255 } };
	unsigned char got[4] = { 0 };

	GL(glClearColor, float, float, float, float)(0.2f * (float)frame, 0.4f, 0.6f, 1);
	GL(glClear, unsigned)(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	GL(glEnable, unsigned)(GL_DEPTH_TEST);
	GL(glColor3ub, unsigned char, unsigned char, unsigned char)(want[frame][0], want[frame][1], want[frame][2]);
	GL(glBegin, unsigned)(GL_TRIANGLES);
	GL(glVertex3f, float, float, float)(-0.8f, -0.7f, 0.1f * (float)frame);
	GL(glVertex3f, float, float, float)(0.9f, -0.6f, 0);
	GL(glVertex3f, float, float, float)(0.1f * (float)frame, 0.85f, 0);
	GL(glEnd, void)();
	GL(glReadPixels, int, int, int, int, unsigned, unsigned, void *)
	(SIDE / 2, SIDE / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, got);
	return memcmp(got, want[frame], 3) == 0;
}

int main(int argc, char **argv)
{
	const char *how = argc > 1 ? argv[1] : "pbuffer";
	int good = 1;

	if (strcmp(how, "osmesa") == 0)
		begin_osmesa();
	else
		begin_egl(how);
	if (strcmp(how, "surfaceless") == 0 || strcmp(how, "device") == 0)
		make_object();
	for (int frame = 0; frame < FRAMES; frame++) {
		good &= draw(frame);
		if (surface)
			EGL(unsigned, eglSwapBuffers, void *, void *)(display, surface);
		else
			GL(glFinish, void)();
	}
	return good && ((unsigned (*)(void))gl("glGetError"))() == GL_NO_ERROR ? 0 : 1;
}
