/*
 * Windows full of panels. Each panel draws the same object under different state, so that one frame covers a whole
 * table of modes, functions, operands or terms from a chapter of the specification. Recorded by test_panels.py.
 */
#pragma once

#include <stdlib.h>
#include <string.h>

#include "tests/trace/window.h"

enum { PANEL = 20, ACROSS = 16, DOWN = 12, PANELS = ACROSS * DOWN };

/**
 * A table: its number of rows, a function that sets the state of row i, and one that draws into a square from -1 to 1.
 */
struct table {
	int n;
	void (*set)(int i);
	void (*draw)(int i);
};

/** The extension that a program's last table needs; without it the table is omitted. NULL: none. */
static const char *last_needs;

/* For a table that is a product of choices: returns the current choice out of `count` and divides i by count. */
static inline int choose(int *i, int count)
{
	const int chosen = *i % count;

	*i /= count;
	return chosen;
}

/* A number in [0, 1) for each i, the same in every run. */
static inline float noise(unsigned i)
{
	i = i * 2654435761u ^ i >> 13;
	i = i * 2246822519u ^ i >> 15;
	return (float)(i >> 8 & 0xffff) / 65536;
}

/* turn: how often the tables have been drawn, each time from another side */
static inline void set_matrices(int turn)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.5, 0.5, -0.5, 0.5, 1, 20);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glTranslatef(0, 0, -2.2f);
	glRotatef(20 * (float)turn, 0.3f, 1, 0.2f);
}

static inline void draw_table(const struct table *t, int turn)
{
	expect(t->n <= PANELS, "the table has a panel for each row");
	glViewport(0, 0, ACROSS * PANEL, DOWN * PANEL);
	glClearColor(0.25f, 0.3f, 0.35f, 0.6f);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	for (int i = 0; i < t->n; i++) {
		const int x = i % ACROSS * PANEL, y = i / ACROSS * PANEL;

		glPushAttrib(GL_ALL_ATTRIB_BITS);
		glViewport(x, y, PANEL, PANEL);
		glScissor(x, y, PANEL, PANEL);
		glEnable(GL_SCISSOR_TEST);
		set_matrices(turn);
		t->set(i);
		t->draw(i);
		glPopAttrib();
		glDisable(GL_COLOR_SUM); /* Mesa (22.3.6) does not restore these two */
		glFogi(GL_FOG_COORD_SRC, GL_FRAGMENT_DEPTH);
		glActiveTexture(GL_TEXTURE0);
	}
}

/** Opens the window and draws each table as a frame; then rotated versions, up to the number of frames in the
 * environment variable PANEL_FRAMES. */
static inline void draw_tables(const struct table *tables, size_t n, void (*prepare)(void))
{
	const char *frames = getenv("PANEL_FRAMES");
	const size_t most = frames ? (size_t)atoi(frames) : 0;
	int attributes[] = {
		GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_ALPHA_SIZE, 8, GLX_DEPTH_SIZE, 24, GLX_STENCIL_SIZE, 8,
		None
	};

	window_size[0] = ACROSS * PANEL;
	window_size[1] = DOWN * PANEL;
	open_window_of(attributes);
	if (prepare)
		prepare();
	if (last_needs && !strstr((const char *)glGetString(GL_EXTENSIONS), last_needs))
		n--;
	for (size_t i = 0; i < n || i < most; i++) {
		draw_table(&tables[i % n], (int)(i / n));
		end_frame();
	}
	expect(glGetError() == GL_NO_ERROR, "no error");
}

#define DRAW_TABLES(tables, prepare) draw_tables(tables, sizeof(tables) / sizeof((tables)[0]), prepare)
