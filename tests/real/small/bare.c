/*
 * A window without depth and stencil buffers, where llvmpipe clips at twice the view's size: lines, points and outlines
 * that extend slightly and far out of the view. One frame each; recorded by test_small.py. Filled triangles are clipped
 * at the view there, too, and some of their edge pixels differ.
 */
#include "tests/trace/window.h"

/* Ends of lines: inside the view, and outside on each side by less and by more than the view's size. */
static const float ends[12][2] = { { 0.9f, -0.9f }, { 0.9f, 0.9f }, { -1.9f, 0 },    { 0.3f, -2.7f },
	                           { 0, 0 },        { 1.3f, 1.7f }, { -0.4f, 0.2f }, { -3.1f, 1.1f },
	                           { 0.2f, 0.7f },  { 0.1f, 5 },    { 1.1f, -0.2f }, { -1.2f, -0.6f } };

static void before(void)
{
	glClear(GL_COLOR_BUFFER_BIT);
	glColor3f(0.9f, 0.7f, 0.2f);
	glLineWidth(1);
	glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

static void draw(GLenum mode)
{
	glBegin(mode);
	for (int i = 0; i < 12; i++) {
		glColor3f(0.3f + 0.05f * (float)i, 1 - 0.07f * (float)i, (float)(i % 3) / 2);
		glVertex2fv(ends[i]);
	}
	glEnd();
}

static void lines(void)
{
	draw(GL_LINES);
}

static void strip(void)
{
	draw(GL_LINE_STRIP);
}

static void wide_strip(void)
{
	glLineWidth(5);
	draw(GL_LINE_LOOP);
}

static void points(void)
{
	glPointSize(15);
	draw(GL_POINTS);
	glBegin(GL_POINTS);
	for (int i = 0; i < 8; i++)
		glVertex2f(i % 2 ? 1.06f : -1.08f, -0.9f + 0.25f * (float)i);
	glEnd();
	glPointSize(1);
}

static void outlines(void)
{
	glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
	draw(GL_TRIANGLES);
}

int main(void)
{
	static void (*const frames[])(void) = { lines, strip, wide_strip, points, outlines };
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 0, GLX_STENCIL_SIZE, 0, None };
	int depth, stencil;

	window_size[0] = 250;
	window_size[1] = 250;
	window_kind = "one without depth and stencil";
	open_window_of(attributes);
	glGetIntegerv(GL_DEPTH_BITS, &depth);
	glGetIntegerv(GL_STENCIL_BITS, &stencil);
	if (depth || stencil) {
		fprintf(stderr, "skipped: this GL has no such window: %s\n", window_kind);
		return 77;
	}
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), before);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
