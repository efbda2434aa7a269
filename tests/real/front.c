/*
 * Front and back buffers, one aspect per frame: drawing to the front buffer or to both, reading and copying from it,
 * and the depth buffer that they share. Recorded by test_front.py, where frames end with each swap and each flush.
 * Mesa's software rasterizers (22.3.6) leave the front buffer's old contents after a swap, so its colours are cleared
 * after each; tests/gl/test_front.c tests the contents after a swap.
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

/* Back buffer only. */
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

/* A rubber band over the picture. */
static void band(void)
{
	glDrawBuffer(GL_FRONT);
	clear_colors(0.2f, 0.4f, 0.8f);
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_COLOR_LOGIC_OP);
	glLogicOp(GL_XOR);
	panel(2, 20, 0, 50, 4, 1, 1, 1);
	glFlush();
	panel(20, 2, 0, 4, 40, 1, 1, 1); /* over the previous band */
	glFlush();
	glDisable(GL_COLOR_LOGIC_OP);
	glEnable(GL_DEPTH_TEST);
	glDrawBuffer(GL_BACK);
}

/* Drawing to the front buffer does not change the picture, but its depth hides later drawing. */
static void hides(void)
{
	clear(0, 0.2f, 0.2f);
	glDrawBuffer(GL_FRONT);
	panel(10, 10, 4, 20, 20, 1, 0, 1);
	glDrawBuffer(GL_BACK);
	panel(20, 20, 2, 30, 20, 0.2f, 1, 0.2f);
	end_frame();
}

/* Depths from the back buffer, some of them from an earlier frame. */
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

/*
 * Draw to both at once: the picture of the back buffer, then that of the front buffer, which lacks the drawing in
 * between.
 */
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

/* With glDrawBuffers, of the extension and of GL 2.0. */
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

/* Copy pixels from the front to the back buffer. */
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

/* No swaps: a clear of its own, then further drawing. */
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

/* A flush after a primitive that ends in a display list. */
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
