/*
 * Pixel operations, one per frame: bitmaps in lists, lit raster positions, pixel rectangles with zoom and scale, copies
 * of the screen, stencil and depth values, frames without a clear, smooth lines and points. Recorded by test_pixels.py.
 */
#include "tests/trace/window.h"

static const unsigned char letter[] = { 0x00, 0x00, 0xc3, 0xc3, 0xc3, 0xc3, 0xff, 0xc3, 0xc3, 0xc3, 0x66, 0x3c, 0x18 };
static unsigned char image[16][16][4];

static void reset(int clear)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, 64, 0, 48, -10, 10);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	if (clear)
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

static void text(void)
{
	glColor3f(1, 0.5f, 0.25f);
	glRasterPos2f(3.3f, 30.8f);
	for (int i = 0; i < 4; i++)
		glCallList(1);
	glWindowPos2i(5, 5);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 4); /* differs from the value when the list was made */
	glCallList(1);
	glRasterPos2f(70, 10); /* outside: the position is invalid, and nothing is drawn */
	glCallList(1);
}

static void lit_text(void)
{
	static const float where[4] = { 0, 0, 1, 0 }, red[4] = { 0.9f, 0.2f, 0.1f, 1 };

	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, where);
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, red);
	glNormal3f(0, 0.6f, 0.8f);
	glRasterPos2f(8, 20);
	glCallList(1);
	glRasterPos3f(30, 20, -4);
	glCallList(1);
	glDisable(GL_LIGHTING);
}

static void rectangles(void)
{
	glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
	glRasterPos2f(2, 2);
	glDrawPixels(16, 16, GL_RGBA, GL_UNSIGNED_BYTE, image);
	glRasterPos2f(22, 20);
	glPixelZoom(2.61f, -1.37f); /* no pixel centre is on a border between two pixels */
	glDrawPixels(16, 16, GL_RGBA, GL_UNSIGNED_BYTE, image);
	glPixelZoom(1, 1);
	glPixelTransferf(GL_RED_SCALE, 0.5f);
	glPixelTransferf(GL_BLUE_BIAS, 0.25f);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glRasterPos2f(10, 10);
	glDrawPixels(16, 16, GL_RGBA, GL_UNSIGNED_BYTE, image);
	glDisable(GL_BLEND);
	glPixelTransferf(GL_RED_SCALE, 1);
	glPixelTransferf(GL_BLUE_BIAS, 0);
	glRasterPos2f(40, 25);
	glCopyPixels(2, 2, 16, 16, GL_COLOR);
}

static void values(void)
{
	static unsigned char stencil[16 * 16];
	static float depth[16 * 16];

	for (int i = 0; i < 256; i++) {
		stencil[i] = (unsigned char)((i / 16 + i % 16) & 1);
		depth[i] = (float)(i % 16) / 16;
	}
	glWindowPos2i(4, 4);
	glDrawPixels(16, 16, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, stencil);
	glEnable(GL_STENCIL_TEST);
	glStencilFunc(GL_EQUAL, 1, 1);
	glColor3f(0, 1, 0);
	glRecti(0, 0, 30, 30);
	glDisable(GL_STENCIL_TEST);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_ALWAYS);
	glColor3f(0, 0, 1);
	glWindowPos2i(34, 4);
	glDrawPixels(16, 16, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
	glDepthFunc(GL_LESS);
	glColor3f(1, 1, 0);
	glRecti(30, 0, 60, 40); /* at depth one half */
	glDisable(GL_DEPTH_TEST);
}

static void copies(void)
{
	unsigned name;

	rectangles();
	glGenTextures(1, &name);
	glBindTexture(GL_TEXTURE_2D, name);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 32, 32, 0);
	glEnable(GL_TEXTURE_2D);
	glColor3f(1, 1, 1);
	glBegin(GL_QUADS);
	glTexCoord2f(0, 0);
	glVertex2f(31, 15);
	glTexCoord2f(1, 0);
	glVertex2f(63, 15);
	glTexCoord2f(1, 1);
	glVertex2f(63, 47);
	glTexCoord2f(0, 1);
	glVertex2f(31, 47);
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

static void smooth(void)
{
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glEnable(GL_LINE_SMOOTH);
	glEnable(GL_POINT_SMOOTH);
	glColor3f(1, 1, 1);
	for (int i = 1; i < 5; i++) {
		glLineWidth((float)i * 0.8f);
		glBegin(GL_LINES);
		glVertex2f(3, 5 * (float)i);
		glVertex2f(30, 9 * (float)i);
		glEnd();
		glPointSize((float)i * 1.7f);
		glBegin(GL_POINTS);
		glVertex2f(34.3f + 7 * (float)i, 20.7f);
		glEnd();
	}
	glDisable(GL_BLEND);
	glDisable(GL_LINE_SMOOTH);
	glDisable(GL_POINT_SMOOTH);
}

static void uncleared(void)
{
	glColor3f(0.2f, 0.4f, 0.6f);
	glRecti(20, 20, 30, 30);
}

int main(void)
{
	static void (*const frames[])(void) = { text,   lit_text,  rectangles, values, copies,
		                                smooth, uncleared, uncleared,  text };

	open_window();
	for (int i = 0; i < 16 * 16; i++) {
		unsigned char *p = image[i / 16][i % 16];

		p[0] = (unsigned char)(i % 16 * 17);
		p[1] = (unsigned char)(i / 16 * 17);
		p[2] = (unsigned char)(i & 1 ? 255 : 40);
		p[3] = (unsigned char)(255 - i / 2);
	}
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glNewList(1, GL_COMPILE);
	glBitmap(8, 13, 0, 2, 10, 0, letter);
	glEndList();
	for (unsigned i = 0; i < sizeof(frames) / sizeof(frames[0]); i++) {
		reset(frames[i] != uncleared);
		frames[i]();
		end_frame();
	}
	return 0;
}
