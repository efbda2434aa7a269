/*
 * Differences between WGL and GLX, for test_wine.py: text by wglUseFontBitmaps, a display list of another context
 * through wglShareLists, a picture drawn in a pbuffer. Ten frames of 320 x 240.
 */
#include <windows.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/wglext.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 320, HEIGHT = 240, SIDE = 64, FRAMES = 10, GLYPHS = 1, STAR = 300 };

static HDC window_device;
static HGLRC window_context;

static void expect(int truth, const char *what)
{
	if (!truth) {
		fprintf(stderr, "not so: %s\n", what);
		exit(1);
	}
}

static void *find(const char *name)
{
	void *found = (void *)wglGetProcAddress(name);

	expect(found != NULL, name);
	return found;
}

static void open_window(void)
{
	const WNDCLASSA kind = { .style = CS_OWNDC,
		                 .lpfnWndProc = DefWindowProcA,
		                 .hInstance = GetModuleHandleA(NULL),
		                 .lpszClassName = "wgl" };
	const PIXELFORMATDESCRIPTOR wanted = { .nSize = sizeof(wanted),
		                               .nVersion = 1,
		                               .dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER,
		                               .iPixelType = PFD_TYPE_RGBA,
		                               .cColorBits = 24,
		                               .cDepthBits = 24 };

	expect(RegisterClassA(&kind), "a class of windows");
	window_device = GetDC(CreateWindowA("wgl", "wgl", WS_POPUP | WS_VISIBLE, 0, 0, WIDTH, HEIGHT, NULL, NULL,
	                                    kind.hInstance, NULL));
	expect(SetPixelFormat(window_device, ChoosePixelFormat(window_device, &wanted), &wanted), "a pixel format");
	window_context = wglCreateContext(window_device);
	expect(wglMakeCurrent(window_device, window_context), "a context");
}

/* A list compiled by another context and called by this one. */
static void share_list(void)
{
	const HGLRC other = wglCreateContext(window_device);

	expect(wglShareLists(window_context, other) && wglMakeCurrent(window_device, other), "shared lists");
	glNewList(STAR, GL_COMPILE);
	glBegin(GL_TRIANGLES);
	for (int k = 0; k < 2; k++) {
		const float up = k ? 1 : -1;

		glVertex2f(0, up);
		glVertex2f(-0.87f * up, -0.5f * up);
		glVertex2f(0.87f * up, -0.5f * up);
	}
	glEnd();
	glEndList();
	expect(wglMakeCurrent(window_device, window_context) && wglDeleteContext(other), "back to the window's context");
}

/* A texture drawn by a pbuffer's context. */
static void make_texture(void)
{
	static unsigned char pixels[SIDE * SIDE * 4];
	const int attributes[] = {
		WGL_DRAW_TO_PBUFFER_ARB, 1, WGL_SUPPORT_OPENGL_ARB, 1, WGL_PIXEL_TYPE_ARB, WGL_TYPE_RGBA_ARB,
		WGL_COLOR_BITS_ARB, 24, WGL_ALPHA_BITS_ARB, 8, WGL_DOUBLE_BUFFER_ARB, 1, 0
	};
	const PFNWGLCHOOSEPIXELFORMATARBPROC choose = find("wglChoosePixelFormatARB");
	const PFNWGLCREATEPBUFFERARBPROC create = find("wglCreatePbufferARB");
	const PFNWGLGETPBUFFERDCARBPROC get_device = find("wglGetPbufferDCARB");
	HPBUFFERARB buffer;
	HGLRC context;
	HDC device;
	UINT n;
	int format;

	expect(choose(window_device, attributes, NULL, 1, &format, &n) && n, "a pixel format of pbuffers");
	buffer = create(window_device, format, SIDE, SIDE, (const int[]){ 0 });
	expect(buffer != NULL, "a pbuffer");
	device = get_device(buffer);
	context = wglCreateContext(device);
	expect(wglMakeCurrent(device, context), "a context of a pbuffer");
	glClearColor(0.8f, 0.3f, 0.1f, 1);
	glClear(GL_COLOR_BUFFER_BIT);
	glColor3f(0.2f, 0.9f, 0.4f);
	glRectf(-0.5f, -0.75f, 0.5f, 0.25f);
	glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
	expect(wglMakeCurrent(window_device, window_context) && wglDeleteContext(context), "back to the window's context");
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}

static void draw_text(int frame)
{
	char text[40];
	const int length = snprintf(text, sizeof(text), "Frame-%d-of-WGL", frame);

	glColor3f(1, 1, 0.5f);
	glRasterPos2f(-0.9f, 0.8f);
	glListBase(GLYPHS - ' ');
	glCallLists(length, GL_UNSIGNED_BYTE, text);
}

static void draw(int frame)
{
	glClearColor(0.1f, 0.1f, 0.3f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_TEXTURE_2D);
	glColor3f(1, 1, 1);
	glBegin(GL_QUADS);
	glTexCoord2f(0, 0), glVertex2f(-0.9f, -0.9f);
	glTexCoord2f(1, 0), glVertex2f(0, -0.9f);
	glTexCoord2f(1, 1), glVertex2f(0, 0.3f);
	glTexCoord2f(0, 1), glVertex2f(-0.9f, 0.3f);
	glEnd();
	glDisable(GL_TEXTURE_2D);
	glColor3f(0.4f, 0.7f, 1);
	glPushMatrix();
	glTranslatef(0.5f, -0.2f, 0);
	glRotatef(7 * (float)frame, 0, 0, 1);
	glScalef(0.3f, 0.4f, 1);
	glCallList(STAR);
	glPopMatrix();
	draw_text(frame);
}

int main(void)
{
	open_window();
	share_list();
	make_texture();
	SelectObject(window_device, GetStockObject(SYSTEM_FONT));
	expect(wglUseFontBitmapsA(window_device, ' ', 96, GLYPHS), "letters as lists");
	/* Mesa 22.3.6 reports out of memory for a space, whose bitmap has no bytes, and leaves its list empty */
	glGetError();
	for (int frame = 0; frame < FRAMES; frame++) {
		draw(frame);
		expect(glGetError() == GL_NO_ERROR, "a frame without an error");
		SwapBuffers(window_device);
	}
	return 0;
}
