/*
 * Colours that are the same at all corners, in perspective: llvmpipe interpolates them, and the alpha test shows which
 * pixels its rounding errors take above the reference. A frame each; recorded by test_small.py.
 */
#include "tests/trace/window.h"

static void corner(float x, float y, float z)
{
	glTexCoord2f(x * 0.1f, y * 0.1f);
	glVertex3f(x, y, z);
}

static void corners(void)
{
	corner(-20, -1, -1.5f);
	corner(20, -1, -1.5f);
	corner(50, 30, -80);
	corner(-50, 30, -80);
}

static void ground(void)
{
	glBegin(GL_QUADS);
	corners();
	glEnd();
}

static void inside(void)
{
	glBegin(GL_QUADS);
	glColor4f(0.5f, 0.3f, 0.9f, 0.3f);
	corners();
	glEnd();
}

static void plain(void)
{
	ground();
}

static void clipped(void)
{
	glBegin(GL_TRIANGLES);
	glColor4f(0.5f, 0.3f, 0.9f, 0.3f);
	corner(0.3f, -1, 2);
	corner(20, 9, -60);
	corner(-30, 20, -70);
	corner(-0.3f, -0.05f, 1);
	corner(9, -3, -20);
	corner(-8, -4, -15);
	glEnd();
}

static void lit(void)
{
	static const GLfloat diffuse[] = { 0.2f, 0.5f, 0.3f, 0.3f };

	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, diffuse);
	ground();
	glDisable(GL_LIGHTING);
}

static void textured(void)
{
	static const GLubyte white[2 * 2 * 4] = { 255, 255, 255, 255, 90, 180, 255, 255, 70, 255, 90, 255, 255, 80, 90, 255 };

	glEnable(GL_TEXTURE_2D);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, white);
	inside();
	glDisable(GL_TEXTURE_2D);
}

static void between(void)
{
	glBegin(GL_TRIANGLES);
	corner(-20, -1, -1.5f);
	glColor4f(0.9f, 0.2f, 0.3f, 0.3f);
	corner(20, -1, -1.5f);
	glColor4f(0.1f, 0.9f, 0.5f, 0.3f);
	corner(0, 30, -60);
	glEnd();
}

static void flat(void)
{
	glShadeModel(GL_FLAT);
	inside();
	glShadeModel(GL_SMOOTH);
}

static void second(void)
{
	glEnable(GL_COLOR_SUM);
	glSecondaryColor3f(0.1f, 0.3f, 0.5f);
	inside();
	glDisable(GL_COLOR_SUM);
}

static void parallel(void)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glScalef(1, 1, 0.01f);
	glBegin(GL_QUADS);
	glColor4f(0.5f, 0.3f, 0.9f, 0.3f);
	glVertex4f(-2.7f, -2.7f, 0, 3);
	glVertex4f(2.5f, -2.6f, 0, 3);
	glVertex4f(2.6f, 2.7f, 0, 3);
	glVertex4f(-2.4f, 2.6f, 0, 3);
	glEnd();
}

static void listed(void)
{
	glNewList(1, GL_COMPILE);
	inside();
	glEndList();
	glCallList(1);
}

static void listed_outside(void)
{
	glNewList(1, GL_COMPILE);
	glColor4f(0.5f, 0.3f, 0.9f, 0.3f);
	ground();
	glEndList();
	glCallList(1);
}

static void arrays(void)
{
	static const GLfloat places[] = { -20, -1, -1.5f, 20, -1, -1.5f, 50, 30, -80, -50, 30, -80 };
	static const GLfloat colors[] = { .5f, .3f, .9f, .3f, .5f, .3f, .9f, .3f, .5f, .3f, .9f, .3f, .5f, .3f, .9f, .3f };

	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	glVertexPointer(3, GL_FLOAT, 0, places);
	glColorPointer(4, GL_FLOAT, 0, colors);
	glDrawArrays(GL_QUADS, 0, 4);
	glDisableClientState(GL_VERTEX_ARRAY);
	glDisableClientState(GL_COLOR_ARRAY);
}

/* Many quads before the ground, and its colour set in between. */
static void after(int quads)
{
	glBegin(GL_QUADS);
	for (int i = 0; i < 4 * quads; i++)
		corner((float)(i % 4) * 0.01f - 2, -1, -2);
	glEnd();
	glColor4f(0.5f, 0.3f, 0.9f, 0.3f);
	ground();
}

static void after_few(void)
{
	after(1);
}

static void after_many(void)
{
	after(9);
}

static void points(void)
{
	glColor4f(0.5f, 0.3f, 0.9f, 0.3f);
	glPointSize(7);
	glBegin(GL_POINTS);
	glColor4f(0.5f, 0.3f, 0.9f, 0.3f);
	for (int i = 0; i < 20; i++)
		corner((float)(i % 5) * 0.7f - 1.3f, (float)(i / 5) * 0.6f - 0.9f, -1.3f - 0.07f * (float)i);
	glEnd();
}

int main(void)
{
	static void (*const frames[])(void) = {
		plain, inside, listed, listed_outside, arrays, after_few, after_many, clipped, lit, textured, between, flat, second,
		parallel, points
	};

	open_window();
	glClearColor(0.1f, 0.2f, 0.3f, 1);
	glEnable(GL_ALPHA_TEST);
	glAlphaFunc(GL_LEQUAL, 0.3f);
	for (unsigned i = 0; i < sizeof(frames) / sizeof(*frames); i++) {
		begin_view();
		glColor4f(0.5f, 0.3f, 0.9f, 0.3f);
		frames[i]();
		end_frame();
	}
	return 0;
}
