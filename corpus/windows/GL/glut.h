/*
 * The part of GLUT that some corpus programs need, on WGL: a Windows window, its pixel format and context, and a frame
 * loop. Programs that need only OpenGL 1.1 are built with it by mingw-w64, unchanged.
 */
#pragma once

#include <windows.h>
#include <GL/gl.h>
#include <GL/glu.h>
#include <stdio.h>
#include <stdlib.h>

#undef near /* macros of windows.h */
#undef far

enum { GLUT_RGB = 0, GLUT_DOUBLE = 2, GLUT_DEPTH = 16, GLUT_STENCIL = 32 };

static struct {
	unsigned mode; /* GLUT_ bits */
	int width, height;
	HDC device;
	void (*display)(void);
} glut;

static LRESULT CALLBACK glut_message(HWND window, UINT message, WPARAM w, LPARAM l)
{
	if (message == WM_DESTROY)
		PostQuitMessage(0);
	return DefWindowProcA(window, message, w, l);
}

static inline void glutInit(int *argc, char **argv)
{
	(void)argc;
	(void)argv;
}

static inline void glutInitDisplayMode(unsigned mode)
{
	glut.mode = mode;
}

static inline void glutInitWindowSize(int width, int height)
{
	glut.width = width;
	glut.height = height;
}

static inline int glutCreateWindow(const char *title)
{
	const WNDCLASSA kind = { .style = CS_OWNDC,
		                 .lpfnWndProc = glut_message,
		                 .hInstance = GetModuleHandleA(NULL),
		                 .lpszClassName = "corpus" };
	const PIXELFORMATDESCRIPTOR wanted = {
		.nSize = sizeof(wanted), .nVersion = 1, .dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER,
		.iPixelType = PFD_TYPE_RGBA, .cColorBits = 24, .cDepthBits = 24,
		.cStencilBits = glut.mode & GLUT_STENCIL ? 8 : 0
	};
	HWND window;
	HGLRC context;

	RegisterClassA(&kind);
	window = CreateWindowA("corpus", title, WS_POPUP | WS_VISIBLE, 0, 0, glut.width, glut.height, NULL, NULL,
	                       kind.hInstance, NULL);
	glut.device = GetDC(window);
	SetPixelFormat(glut.device, ChoosePixelFormat(glut.device, &wanted), &wanted);
	context = wglCreateContext(glut.device);
	if (!context || !wglMakeCurrent(glut.device, context)) {
		fprintf(stderr, "no context\n");
		exit(1);
	}
	return 1;
}

static inline void glutDisplayFunc(void (*display)(void))
{
	glut.display = display;
}

static inline void glutPostRedisplay(void)
{
}

static inline void glutSwapBuffers(void)
{
	SwapBuffers(glut.device);
}

static inline void glutMainLoop(void)
{
	for (MSG message;;) {
		while (PeekMessageA(&message, NULL, 0, 0, PM_REMOVE)) {
			if (message.message == WM_QUIT)
				exit(0);
			DispatchMessageA(&message);
		}
		glut.display();
	}
}
