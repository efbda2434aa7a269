/*
 * Pixmaps. With "drawn": three frames drawn to a pixmap, without a window or swaps. Otherwise three frames in a window,
 * textured by a pixmap that X draws to (GLX_EXT_texture_from_pixmap): two-dimensional, or a rectangle texture with the
 * argument "rectangle". Recorded by test_record_pixmaps.py; exits with 77 if the server lacks support.
 */
#include "tests/trace/window.h"

enum { WIDTH = 48, HEIGHT = 40, FRAMES = 3 };

static void draw(int frame)
{
	glViewport(0, 0, WIDTH, HEIGHT);
	glClearColor(0.2f * (float)frame, 0.4f, 0.6f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glBegin(GL_TRIANGLES);
	glColor3f(1, 0, 0);
	glVertex3f(-0.8f, -0.7f, 0.1f * (float)frame);
	glColor3f(0, 1, 0);
	glVertex3f(0.9f, -0.6f, 0);
	glColor3f(0, 0, 1);
	glVertex3f(0.1f * (float)frame, 0.85f, 0);
	glEnd();
}

static Pixmap make_pixmap(void)
{
	return XCreatePixmap(display, DefaultRootWindow(display), WIDTH, HEIGHT,
	                     (unsigned)DefaultDepth(display, DefaultScreen(display)));
}

static void draw_to_pixmap(void)
{
	int attributes[] = { GLX_RGBA, GLX_DEPTH_SIZE, 16, GLX_RED_SIZE, 8, None };
	XVisualInfo *visual;
	GLXPixmap target;

	display = XOpenDisplay(NULL);
	if (!display || !(visual = glXChooseVisual(display, DefaultScreen(display), attributes)) ||
	    visual->depth != DefaultDepth(display, DefaultScreen(display)))
		exit(77);
	target = glXCreateGLXPixmap(display, visual, make_pixmap());
	if (!glXMakeCurrent(display, target, glXCreateContext(display, visual, NULL, True)))
		exit(77);
	for (int frame = 0; frame < FRAMES; frame++) {
		draw(frame);
		glFinish();
	}
}

/* X draws bars and an asymmetric corner, which shows any rotation or flip. */
static void paint(Pixmap pixmap, int frame)
{
	static const unsigned long colors[] = { 0xff2010, 0x30ff20, 0x4050ff, 0xe0e0e0 };
	GC gc = XCreateGC(display, pixmap, 0, NULL);

	for (int i = 0; i < 4; i++) {
		XSetForeground(display, gc, colors[(i + frame) % 4]);
		XFillRectangle(display, pixmap, gc, i * WIDTH / 4, 0, WIDTH / 4, HEIGHT);
	}
	XSetForeground(display, gc, 0x102030);
	XFillRectangle(display, pixmap, gc, 0, 0, WIDTH / 3, HEIGHT / 3);
	XFreeGC(display, gc);
	XSync(display, False);
}

static void quad(float right, float top)
{
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		const float x = i == 1 || i == 2, y = i > 1;

		glTexCoord2f(x * right, y * top);
		glVertex2f(1.8f * x - 0.9f, 1.6f * y - 0.8f);
	}
	glEnd();
}

static GLXPixmap pixmap_as_texture(Pixmap pixmap, int is_rectangle)
{
	const int wanted[] = {
		GLX_DRAWABLE_TYPE, GLX_PIXMAP_BIT, GLX_BIND_TO_TEXTURE_RGB_EXT, True, GLX_DOUBLEBUFFER, False, GLX_DEPTH_SIZE,
		0, GLX_RED_SIZE, 8, GLX_ALPHA_SIZE, 0, None
	};
	const int attributes[] = { GLX_TEXTURE_TARGET_EXT,
		                   is_rectangle ? GLX_TEXTURE_RECTANGLE_EXT : GLX_TEXTURE_2D_EXT,
		                   GLX_TEXTURE_FORMAT_EXT, GLX_TEXTURE_FORMAT_RGB_EXT, None };
	int n = 0;
	GLXFBConfig *configs = glXChooseFBConfig(display, DefaultScreen(display), wanted, &n);

	for (int i = 0; i < n; i++) {
		XVisualInfo *visual = glXGetVisualFromFBConfig(display, configs[i]);

		if (visual && visual->depth == DefaultDepth(display, DefaultScreen(display)))
			return glXCreatePixmap(display, configs[i], pixmap, attributes);
	}
	exit(77);
}

static void draw_pixmap(int is_rectangle)
{
	PFNGLXBINDTEXIMAGEEXTPROC bind = (PFNGLXBINDTEXIMAGEEXTPROC)glXGetProcAddressARB(
		(const GLubyte *)"glXBindTexImageEXT");
	PFNGLXRELEASETEXIMAGEEXTPROC release = (PFNGLXRELEASETEXIMAGEEXTPROC)glXGetProcAddressARB(
		(const GLubyte *)"glXReleaseTexImageEXT");
	const GLenum target = is_rectangle ? GL_TEXTURE_RECTANGLE : GL_TEXTURE_2D;
	GLXPixmap source;
	Pixmap pixmap;
	GLuint name;

	open_window();
	if (!strstr(glXQueryExtensionsString(display, DefaultScreen(display)), "GLX_EXT_texture_from_pixmap"))
		exit(77);
	pixmap = make_pixmap();
	source = pixmap_as_texture(pixmap, is_rectangle);
	glGenTextures(1, &name);
	glBindTexture(target, name);
	glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	glEnable(target);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 7); /* state of the program's own uploads, which must be preserved */
	for (int frame = 0; frame < FRAMES; frame++) {
		GLint row = 0;

		paint(pixmap, frame);
		bind(display, source, GLX_FRONT_LEFT_EXT, NULL);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		quad(is_rectangle ? WIDTH : 1, is_rectangle ? HEIGHT : 1);
		release(display, source, GLX_FRONT_LEFT_EXT);
		glGetIntegerv(GL_UNPACK_ROW_LENGTH, &row);
		expect(row == 7 && glGetError() == GL_NO_ERROR, "the program's state is its own");
		end_frame();
	}
}

int main(int argc, char **argv)
{
	const char *how = argc > 1 ? argv[1] : "";

	if (strcmp(how, "drawn") == 0)
		draw_to_pixmap();
	else
		draw_pixmap(strcmp(how, "rectangle") == 0);
	return 0;
}
