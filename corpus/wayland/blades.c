/*
 * cc blades.c -lwayland-client -lwayland-egl -lEGL -lGL -lm
 *
 * Fixed-function OpenGL on Wayland: a lit wheel from a display list in front of a textured wall. `--frames N` ends
 * after N frames; every run draws the same pictures. `--resize` after it resizes the window before a frame or at its
 * end, and prints the size of each frame. The window has no role, so it needs no shell: it is drawn to but never shown.
 */
#include <EGL/egl.h>
#include <GL/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <wayland-client.h>
#include <wayland-egl.h>

enum { WIDTH = 320, HEIGHT = 240, BLADES = 7, TEXELS = 16 };

static struct wl_compositor *compositor;
static GLuint wheel;

static void fail(const char *what)
{
	fprintf(stderr, "no %s\n", what);
	exit(1);
}

static void note_global(void *data, struct wl_registry *registry, uint32_t name, const char *interface,
                        uint32_t version)
{
	(void)data, (void)version;
	if (strcmp(interface, "wl_compositor") == 0)
		compositor = wl_registry_bind(registry, name, &wl_compositor_interface, 1);
}

static void note_removed(void *data, struct wl_registry *registry, uint32_t name)
{
	(void)data, (void)registry, (void)name;
}

static struct wl_egl_window *open_window(struct wl_display *display)
{
	static const struct wl_registry_listener listener = { note_global, note_removed };

	wl_registry_add_listener(wl_display_get_registry(display), &listener, NULL);
	wl_display_roundtrip(display);
	if (!compositor)
		fail("compositor");
	return wl_egl_window_create(wl_compositor_create_surface(compositor), WIDTH, HEIGHT);
}

static void blade(float angle)
{
	const float c = cosf(angle), s = sinf(angle), next = angle + 0.5f;

	glBegin(GL_QUADS);
	glNormal3f(0.3f * c, 0.3f * s, 0.95f);
	glVertex3f(0.2f * c, 0.2f * s, 0);
	glVertex3f(c, s, 0.2f);
	glNormal3f(0.3f * cosf(next), 0.3f * sinf(next), 0.95f);
	glVertex3f(cosf(next), sinf(next), -0.2f);
	glVertex3f(0.2f * cosf(next), 0.2f * sinf(next), 0);
	glEnd();
}

static void set_up(void)
{
	static const GLfloat sun[4] = { 1, 2, 3, 0 }, red[4] = { 0.9f, 0.3f, 0.2f, 1 };
	static GLubyte texels[TEXELS][TEXELS][3];

	for (int i = 0; i < TEXELS * TEXELS; i++) {
		texels[i / TEXELS][i % TEXELS][0] = (GLubyte)(60 + 10 * (i % TEXELS));
		texels[i / TEXELS][i % TEXELS][1] = (GLubyte)((i / TEXELS + i) % 2 ? 160 : 90);
		texels[i / TEXELS][i % TEXELS][2] = (GLubyte)(12 * (i / TEXELS));
	}
	glViewport(0, 0, WIDTH, HEIGHT);
	glMatrixMode(GL_PROJECTION);
	glFrustum(-0.64, 0.64, -0.48, 0.48, 1, 10);
	glMatrixMode(GL_MODELVIEW);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, TEXELS, TEXELS, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
	glLightfv(GL_LIGHT0, GL_POSITION, sun);
	glEnable(GL_LIGHT0);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_NORMALIZE);
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, red);
	wheel = glGenLists(1);
	glNewList(wheel, GL_COMPILE);
	for (int i = 0; i < BLADES; i++)
		blade(6.2831853f * (float)i / BLADES);
	glEndList();
}

static void draw_frame(int frame)
{
	glLoadIdentity();
	glTranslatef(0, 0, -3);
	glClearColor(0.1f, 0.2f, 0.3f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_TEXTURE_2D);
	glBegin(GL_TRIANGLE_STRIP);
	for (int i = 0; i < 4; i++) {
		glTexCoord2f(i % 2 ? 1.5f : 0, i / 2 ? 1.5f : 0);
		glVertex3f(i % 2 ? 1.4f : -1.4f, i / 2 ? 1.1f : -1.1f, -1);
	}
	glEnd();
	glDisable(GL_TEXTURE_2D);
	glEnable(GL_LIGHTING);
	glRotatef(9 * (float)frame, 0.2f, 0.1f, 1);
	glCallList(wheel);
	glDisable(GL_LIGHTING);
}

static void print_size(EGLDisplay egl, EGLSurface surface)
{
	EGLint width, height;

	eglQuerySurface(egl, surface, EGL_WIDTH, &width);
	eglQuerySurface(egl, surface, EGL_HEIGHT, &height);
	printf("%dx%d\n", width, height);
}

int main(int argc, char **argv)
{
	const EGLint attributes[] = { EGL_SURFACE_TYPE, EGL_WINDOW_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8,
		                      EGL_DEPTH_SIZE, 24, EGL_NONE };
	const int frames = argc > 2 && strcmp(argv[1], "--frames") == 0 ? atoi(argv[2]) : 10;
	const int resizes = argc > 3 && strcmp(argv[3], "--resize") == 0;
	struct wl_display *display = wl_display_connect(NULL);
	struct wl_egl_window *window;
	EGLDisplay egl;
	EGLContext context;
	EGLSurface surface;
	EGLConfig config;
	EGLint n = 0;

	if (!display)
		fail("display");
	window = open_window(display);
	egl = eglGetDisplay((EGLNativeDisplayType)display);
	if (!eglInitialize(egl, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API) ||
	    !eglChooseConfig(egl, attributes, &config, 1, &n) || !n)
		fail("OpenGL here");
	context = eglCreateContext(egl, config, EGL_NO_CONTEXT, NULL);
	surface = eglCreateWindowSurface(egl, config, (EGLNativeWindowType)window, NULL);
	if (!context || !surface || !eglMakeCurrent(egl, surface, surface, context))
		fail("context");
	eglSwapInterval(egl, 0);
	set_up();
	for (int frame = 0; frame < frames; frame++) {
		const int width = 200 + 40 * (3 * frame % 7), height = 150 + 20 * (5 * frame % 7);

		if (resizes && frame % 3 == 0)
			wl_egl_window_resize(window, width, height, 0, 0);
		if (resizes)
			glViewport(0, 0, width, height);
		draw_frame(frame);
		if (resizes && frame % 3 == 1)
			wl_egl_window_resize(window, width, height, 0, 0);
		if (resizes)
			print_size(egl, surface);
		eglSwapBuffers(egl, surface);
	}
	eglTerminate(egl);
	wl_display_disconnect(display);
	return 0;
}
