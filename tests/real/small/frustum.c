/*
 * Triangles that reach beyond all six planes of the view volume, with one or two vertices behind the eye; each in a
 * viewport of its own. Recorded by test_small.py.
 */
#include "tests/trace/window.h"

enum { ACROSS = 8, DOWN = 6 };

static unsigned state;

static float random_from(float lo, float hi)
{
	state = state * 1664525u + 1013904223u;
	return lo + (hi - lo) * (float)(state >> 8) / 16777216.0f;
}

static unsigned outside(const float *c)
{
	return (c[0] > c[3]) | (c[0] < -c[3]) << 1 | (c[1] > c[3]) << 2 | (c[1] < -c[3]) << 3 | (c[2] > c[3]) << 4 |
	       (c[2] < -c[3]) << 5;
}

/* A triangle whose vertices lie beyond all planes, but not together beyond one. */
static void choose(float corner[3][4])
{
	unsigned all, common;

	do {
		all = 0;
		common = 63;
		for (int i = 0; i < 3; i++) {
			for (int k = 0; k < 4; k++)
				corner[i][k] = random_from(-10, 10);
			all |= outside(corner[i]);
			common &= outside(corner[i]);
		}
	} while (all != 63 || common);
}

static void in_cell(int cell, const float corner[3][4], const int order[3])
{
	glViewport(cell % ACROSS * 8, cell / ACROSS * 8, 8, 8);
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < 3; i++) {
		glColor3f(i == 0, 0.3f + 0.3f * (float)i, i == 2);
		glVertex4fv(corner[order[i]]);
	}
	glEnd();
}

static void draw_orders(void)
{
	static const float corner[3][4] = { { -15.574f, 2.654f, -5.216f, -4.871f },
		                            { 1.71f, -15.52f, -8.74f, -8.298f },
		                            { 10.768f, 14.167f, 13.26f, 13.084f } };
	static const int order[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 }, { 1, 0, 2 }, { 0, 2, 1 } };

	for (int cell = 0; cell < 6; cell++)
		in_cell(cell, corner, order[cell]);
}

static void draw_random(unsigned seed)
{
	static const int order[3] = { 0, 1, 2 };
	float corner[3][4];

	state = seed;
	for (int cell = 0; cell < ACROSS * DOWN; cell++) {
		choose(corner);
		in_cell(cell, (const float(*)[4])corner, order);
	}
}

int main(void)
{
	open_window();
	glEnable(GL_DEPTH_TEST);
	for (unsigned seed = 0; seed < 4; seed++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		if (seed)
			draw_random(seed);
		else
			draw_orders();
		end_frame();
	}
	return 0;
}
