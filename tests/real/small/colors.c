/*
 * Colours and materials in random order: glColor and glMaterial between and inside draws, COLOR_MATERIAL on and off and
 * with other parameters, draws by Begin and by arrays, with and without colour arrays. One frame per seed; recorded by
 * test_small.py.
 */
#include "tests/trace/window.h"

enum { ACROSS = 8, DOWN = 6, SEEDS = 12 };

static unsigned state;

static unsigned roll(unsigned n)
{
	state = state * 1664525u + 1013904223u;
	return (state >> 12) % n;
}

static const float palette[5][4] = { { 0.4f, 0.4f, 0.4f, 1 },
	                             { 0.2f, 0.2f, 0.2f, 1 },
	                             { 0.35f, 0.1f, 0.05f, 1 },
	                             { 0.1f, 0.3f, 0.15f, 1 },
	                             { 0.1f, 0.15f, 0.35f, 1 } };

static void corners(int cell, float out[4][2])
{
	const float x = -1 + 2.0f * (float)(cell % ACROSS) / ACROSS, y = -1 + 2.0f * (float)(cell / ACROSS) / DOWN;

	for (int i = 0; i < 4; i++) {
		out[i][0] = x + (i == 1 || i == 2 ? 1.7f : 0.2f) / ACROSS;
		out[i][1] = y + (i >= 2 ? 1.7f : 0.2f) / DOWN;
	}
}

static void draw_at_once(int cell, int colors)
{
	float at[4][2];

	corners(cell, at);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		if (colors == 2 || (colors && !i))
			glColor4fv(palette[roll(5)]);
		glVertex2fv(at[i]);
	}
	glEnd();
}

static void draw_arrays(int cell, int colors)
{
	float at[4][2], of[4][4];

	corners(cell, at);
	for (int i = 0; i < 4; i++)
		memcpy(of[i], palette[roll(5)], sizeof(of[i]));
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_FLOAT, 0, at);
	if (colors) {
		glEnableClientState(GL_COLOR_ARRAY);
		glColorPointer(4, GL_FLOAT, 0, of);
	}
	glDrawArrays(GL_QUADS, 0, 4);
	glDisableClientState(GL_COLOR_ARRAY);
	if (colors)
		glColor4fv(palette[roll(5)]); /* after a colour array the current colour is undefined */
}

static void draw(int cell)
{
	static void (*const ways[])(int, int) = { draw_at_once, draw_arrays };

	ways[roll(2)](cell, (int)roll(3));
}

/* Change some state, or enable state that is already enabled: calls that change nothing leave Mesa's vertex store
 * unchanged. */
static void change(void)
{
	static unsigned mode = 2, ambient = 5;
	static const GLenum parameters[5] = { GL_AMBIENT, GL_DIFFUSE, GL_AMBIENT_AND_DIFFUSE, GL_EMISSION, GL_SPECULAR };

	switch (roll(8)) {
	case 0: glMaterialfv(GL_FRONT_AND_BACK, parameters[roll(4)], palette[roll(5)]); break;
	case 1:
	case 2: glColor4fv(palette[roll(5)]); break;
	case 3: glEnable(roll(2) ? GL_LIGHTING : GL_LIGHT0); break;
	case 4:
	case 5:
		if (roll(3) == 0)
			glDisable(GL_COLOR_MATERIAL);
		else
			glEnable(GL_COLOR_MATERIAL);
		break;
	case 6:
		mode = (mode + 1 + roll(4)) % 5;
		glColorMaterial(GL_FRONT_AND_BACK, parameters[mode]);
		break;
	default: /* other state that draws use */
		ambient = (ambient + 1 + roll(4)) % 5;
		glLightModelfv(GL_LIGHT_MODEL_AMBIENT, palette[ambient]);
	}
}

int main(void)
{
	window_size[0] = 160;
	window_size[1] = 120;
	open_window();
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 0, 0, 1, 0 });
	glLightfv(GL_LIGHT0, GL_DIFFUSE, (const float[]){ 0.6f, 0.6f, 0.6f, 1 });
	glNormal3f(0, 0, 1);
	for (unsigned seed = 1; seed <= SEEDS; seed++) {
		state = seed * 2654435761u;
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		for (int cell = 0; cell < ACROSS * DOWN; cell++) {
			for (unsigned n = roll(4); n; n--)
				change();
			draw(cell);
		}
		end_frame();
	}
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
