/*
 * One second of a shoal at a given rate: fish that swim past each other at different speeds, all with the same
 * triangles and with vertices computed by the program. Fish outside the picture are not drawn. Behind them a ring of
 * patches opens; the inner ones stretch to many times their size. Recorded by test_shoal.py.
 */
#include <math.h>

#include "tests/trace/window.h"

#define FISH 9
#define LONG 1.4f
#define PARTS 10

/* The shade identifies the fish. */
static void fish(int number, float time)
{
	const float shade = 0.2f + 0.8f * (float)number / (FISH - 1);

	glColor3f(shade, 1 - shade, number % 2 ? 1 : 0.2f);
	glBegin(GL_QUAD_STRIP);
	for (int i = 0; i <= PARTS; i++) {
		const float x = (float)i / PARTS, high = 0.05f + 0.3f * sinf(3 * x);
		const float bent = 0.12f * x * sinf(5 * x - 9 * time - (float)number);

		glVertex3f(LONG * x, bent - high, bent);
		glVertex3f(LONG * x, bent + high, -bent);
	}
	glEnd();
}

static void patch(const float radius[2], float from, float to)
{
	glPushMatrix();
	glRotatef(from, 0, 0, 1);
	glColor3f(0.6f + from / 900, 0.6f, 0.3f + from / 600);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		const float angle = (i == 1 || i == 2 ? to - from : 0) * (float)M_PI / 180, far = radius[i / 2];

		glVertex3f(far * cosf(angle), far * sinf(angle), -14);
	}
	glEnd();
	glPopMatrix();
}

static void draw_ring(float time)
{
	for (int ring = 0; ring < 6; ring++)
		for (int i = 0; i < 12; i++) {
			const float power = 8 - 7 * time; /* all rings but the last are narrow at first */
			const float radius[2] = { 6 * powf((float)ring / 6, power) + 0.02f,
				                      6 * powf((float)(ring + 1) / 6, power) + 0.02f };

			patch(radius, 30 * (float)i, 30 * (float)(i + 1));
		}
}

static void draw_shoal(float time)
{
	for (int i = 0; i < FISH; i++) {
		const float speed = (i % 2 ? 1.0f : -1.0f) * (6 + (float)i), deep = 4.0f + (float)i / 3;
		const float x = speed * (time - 0.1f * (float)(i % 5)) + (i % 2 ? -3.0f : 2.0f);

		if (fabsf(x + LONG / 2) > deep + 0.6f * LONG)
			continue;
		glPushMatrix();
		glTranslatef(x, 0.8f * (float)(i % 4) - 1.2f, -deep);
		fish(i, time);
		glPopMatrix();
	}
}

int main(int argc, char **argv)
{
	const int fps = argc > 1 ? atoi(argv[1]) : 15;

	window_size[0] = 320;
	window_size[1] = 240;
	open_window();
	glEnable(GL_DEPTH_TEST);
	glClearColor(0.1f, 0.2f, 0.4f, 1);
	for (int frame = 0; frame <= fps; frame++) {
		begin_view();
		draw_ring((float)frame / (float)fps);
		draw_shoal((float)frame / (float)fps);
		end_frame();
	}
	return 0;
}
