/*
 * Accumulation that overflows: Mesa's numbers wrap around (undefined in the specification). One frame each. Recorded by
 * test_small.py.
 */
#include "tests/trace/window.h"

static void before(void)
{
	glClearColor(0.9f, 0.5f, 0.2f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_ACCUM_BUFFER_BIT);
}

static void sum(GLenum first, float one, GLenum second, float two)
{
	glAccum(first, one);
	glAccum(second, two);
	glAccum(GL_RETURN, 0.5f);
}

static void add_colors(void)
{
	sum(GL_LOAD, 1, GL_ACCUM, 0.7f);
}
static void add_numbers(void)
{
	sum(GL_LOAD, 1, GL_ADD, 0.6f);
}
static void multiply(void)
{
	sum(GL_LOAD, 0.9f, GL_MULT, 3);
}
static void load(void)
{
	sum(GL_LOAD, 2.5f, GL_MULT, 1);
}
static void fit(void)
{
	sum(GL_LOAD, 0.5f, GL_ACCUM, 0.5f);
}

int main(void)
{
	static void (*const frames[])(void) = { add_colors, add_numbers, multiply, load, fit };
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_ACCUM_RED_SIZE, 16, None };

	window_kind = "one with an accumulation buffer";
	open_window_of(attributes);
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), before);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
