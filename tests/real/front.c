/*
 * Two buffers of a window, one thing a frame: drawn to the front buffer, to both, read from it and copied, with the one
 * depth buffer that they share. Recorded by test_front.py, where frames end with each swap and each flush. Mesa's
 * software rasterizers leave in the front buffer what was drawn there before a swap (22.3.6), so that its colours are
 * cleared after each; tests/gl/test_front.c looks at what a swap puts there.
 */
#include "tests/trace/window.h"

static void panel(int x, int y, int z, int width, int height, float r, float g, float b)
{
	glPushMatrix();
	glTranslatef(0, 0, (float)z);
	glColor3f(r, g, b);
	glRecti(x, y, x + width, y + height);
	glPopMatrix();
}

static void clear(float r, float g, float b)
{
	glClearColor(r, g, b, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

/* The back buffer alone. */
static void back(void)
{
	glEnable(GL_DEPTH_TEST);
	clear(0.2f, 0.4f, 0.6f);
	panel(8, 8, 0, 40, 30, 1, 0.6f, 0);
	end_frame();
}

static void clear_colors(float r, float g, float b)
{
	glClearColor(r, g, b, 1);
	glClear(GL_COLOR_BUFFER_BIT);
}

/* A rubber band over what is there. */
static void band(void)
{
	glDrawBuffer(GL_FRONT);
	clear_colors(0.2f, 0.4f, 0.8f);
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_COLOR_LOGIC_OP);
	glLogicOp(GL_XOR);
	panel(2, 20, 0, 50, 4, 1, 1, 1);
	glFlush();
	panel(20, 2, 0, 4, 40, 1, 1, 1); /* on what the band before left */
	glFlush();
	glDisable(GL_COLOR_LOGIC_OP);
	glEnable(GL_DEPTH_TEST);
	glDrawBuffer(GL_BACK);
}

/* What is drawn to the front buffer is not in the picture, but hides by its depth what is. */
static void hides(void)
{
	clear(0, 0.2f, 0.2f);
	glDrawBuffer(GL_FRONT);
	panel(10, 10, 4, 20, 20, 1, 0, 1);
	glDrawBuffer(GL_BACK);
	panel(20, 20, 2, 30, 20, 0.2f, 1, 0.2f);
	end_frame();
}

/* Depths of what the back buffer got, some of them from an earlier frame. */
static void hidden(void)
{
	clear(0.4f, 0, 0);
	panel(4, 4, 3, 30, 16, 0, 0, 1);
	glDrawBuffer(GL_FRONT);
	clear_colors(0, 0.4f, 0);
	panel(20, 10, 1, 40, 30, 1, 1, 0);
	glFlush();
	glDrawBuffer(GL_BACK);
	panel(50, 30, 3, 10, 10, 1, 1, 1);
	end_frame();
	glDrawBuffer(GL_FRONT);
	clear_colors(0, 0, 0.4f);
	panel(0, 0, 2, 64, 48, 0.6f, 0.6f, 0.6f);
	glFlush();
	glDrawBuffer(GL_BACK);
}

/* Both at once: the picture of the back buffer, then that of the front buffer, which lacks what came between. */
static void both(void)
{
	glDrawBuffer(GL_FRONT_AND_BACK);
	clear(0.6f, 0.6f, 0.4f);
	glDrawBuffer(GL_BACK);
	panel(0, 0, 0, 20, 40, 0, 0, 1);
	glDrawBuffer(GL_FRONT_AND_BACK);
	panel(5, 30, 6, 20, 10, 1, 0, 0);
	glDrawBuffer(GL_FRONT);
	glFlush();
	glDrawBuffer(GL_BACK);
	end_frame();
}

/* As the extension and GL 2.0 say it. */
static void listed(void)
{
	static const GLenum two[] = { GL_BACK_LEFT, GL_FRONT_LEFT }, one[] = { GL_FRONT_LEFT };

	glDrawBuffers(2, two);
	clear(0.2f, 0.2f, 0.2f);
	panel(30, 5, 6, 20, 10, 0, 1, 0);
	glDrawBuffers(1, one);
	glFlush();
	glDrawBuffer(GL_BACK);
	end_frame();
}

/* Pixels of the front buffer, in the back buffer. */
static void copied(void)
{
	glDisable(GL_DEPTH_TEST);
	glDrawBuffer(GL_FRONT);
	clear_colors(0, 0.2f, 0.4f);
	panel(10, 10, 0, 20, 10, 1, 0.4f, 0.4f);
	glDrawBuffer(GL_BACK);
	clear(0, 0, 0);
	glReadBuffer(GL_FRONT);
	glRasterPos2i(32, 10);
	glCopyPixels(20, 0, 30, 30, GL_COLOR);
	glReadBuffer(GL_BACK);
	glEnable(GL_DEPTH_TEST);
	end_frame();
}

/* Never a swap: a clear of its own, and more on what is there. */
static void alone(void)
{
	glDrawBuffer(GL_FRONT);
	clear(0.8f, 0.8f, 1);
	panel(10, 10, 1, 30, 30, 0.2f, 0, 0.4f);
	glFlush();
	panel(5, 20, 0, 50, 10, 0.4f, 1, 0.8f);
	glRasterPos3i(2, 2, 0);
	glDrawPixels(1, 1, GL_RGB, GL_UNSIGNED_BYTE, "\377\0\200");
	glFlush();
	glDrawBuffer(GL_BACK);
}

/* A flush after a primitive that a display list ends. */
static void ended_by_list(void)
{
	const GLuint list = glGenLists(1);

	glNewList(list, GL_COMPILE);
	glVertex2i(10, 40);
	glEnd();
	glEndList();
	glDrawBuffer(GL_FRONT);
	clear(0.3f, 0, 0.5f);
	glColor3f(1, 1, 0.4f);
	glBegin(GL_QUADS);
	glVertex2i(10, 10);
	glVertex2i(50, 10);
	glVertex2i(50, 40);
	glCallList(list);
	glFlush();
	glDrawBuffer(GL_BACK);
}

int main(void)
{
	static void (*const steps[])(void) = { back, band, hides, hidden, both, listed, copied, alone, ended_by_list, back };

	open_window();
	glMatrixMode(GL_PROJECTION);
	glOrtho(0, 64, 0, 48, -10, 10);
	glMatrixMode(GL_MODELVIEW);
	for (unsigned i = 0; i < sizeof(steps) / sizeof(steps[0]); i++)
		steps[i]();
	return 0;
}
