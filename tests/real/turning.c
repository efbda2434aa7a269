/*
 * A half-white disc rotates by 30 degrees per frame about its middle, and a white square of 6 pixels moves 24 pixels to
 * the right per frame; a row of bars shows the frame number. Recorded by test_shutter.py.
 */
#include <math.h>

#include "tests/trace/window.h"

#define FRAMES 6

static void quad(float x, float y, float width, float height)
{
	glBegin(GL_QUADS);
	glVertex2f(x, y);
	glVertex2f(x + width, y);
	glVertex2f(x + width, y + height);
	glVertex2f(x, y + height);
	glEnd();
}

/* Half a disc, from angle 0 to pi. */
static void half(float radius)
{
	glBegin(GL_TRIANGLE_FAN);
	glVertex2f(0, 0);
	for (int i = 0; i <= 64; i++) {
		const float angle = 3.14159265f * (float)i / 64;

		glVertex2f(radius * cosf(angle), radius * sinf(angle));
	}
	glEnd();
}

int main(void)
{
	window_size[0] = 192;
	window_size[1] = 128;
	open_window();
	glMatrixMode(GL_PROJECTION);
	glOrtho(0, 192, 0, 128, -1, 1);
	glMatrixMode(GL_MODELVIEW);
	glClearColor(0, 0, 0, 1);
	for (int frame = 0; frame < FRAMES; frame++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glEnable(GL_DEPTH_TEST);
		glPushMatrix();
		glTranslatef(60, 72, 0);
		glRotatef(30 * (float)frame, 0, 0, 1);
		half(48);
		glPopMatrix();
		glPushMatrix();
		glTranslatef(24 + 24 * (float)frame, 12, 0);
		quad(-3, -3, 6, 6);
		glPopMatrix();
		glDisable(GL_DEPTH_TEST);
		for (int i = 0; i <= frame; i++)
			quad(130, 40 + 10 * (float)i, 40, 5);
		end_frame();
	}
	return 0;
}
