/*
 * Conditional rendering (NV_conditional_render): draws, clears and copies that only happen if a query counted samples.
 * One frame each; recorded by test_small.py.
 */
#include "tests/trace/window.h"

static void rectangle(float x, float y, float z)
{
	glBegin(GL_QUADS);
	glVertex3f(x, y, z);
	glVertex3f(x + 0.5f, y, z);
	glVertex3f(x + 0.5f, y + 0.5f, z);
	glVertex3f(x, y + 0.5f, z);
	glEnd();
}

/* Query a rectangle, either visible or hidden behind another. */
static GLuint ask(int is_seen)
{
	GLuint query;

	glGenQueries(1, &query);
	glColorMask(0, 0, 0, 0);
	glDepthMask(0);
	glBeginQuery(GL_SAMPLES_PASSED, query);
	rectangle(is_seen ? 0.2f : -0.2f, -0.25f, 0);
	glEndQuery(GL_SAMPLES_PASSED);
	glColorMask(1, 1, 1, 1);
	glDepthMask(1);
	return query;
}

static void before(void)
{
	glEnable(GL_DEPTH_TEST);
	glClearColor(0.1f, 0.1f, 0.2f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glColor3f(1, 0.2f, 0);
	rectangle(-0.25f, -0.25f, -0.5f);
}

static void draws(void)
{
	for (int i = 0; i < 4; i++) {
		glBeginConditionalRenderNV(ask(i & 1), i & 2 ? GL_QUERY_NO_WAIT_NV : GL_QUERY_WAIT_NV);
		glColor3f(0.2f * (float)i, 1, 0);
		rectangle(-1 + 0.5f * (float)i, 0.4f, 0);
		glEndConditionalRenderNV();
	}
	glColor3f(1, 1, 1);
	rectangle(-0.25f, -0.9f, 0);
}

static void clears_and_pixels(void)
{
	static const GLubyte pixels[4][3] = { { 255, 0, 255 }, { 0, 255, 255 }, { 255, 255, 0 }, { 90, 90, 90 } };

	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	for (int i = 0; i < 2; i++) {
		glBeginConditionalRenderNV(ask(i), GL_QUERY_BY_REGION_WAIT_NV);
		glEnable(GL_SCISSOR_TEST);
		glScissor(30 * i, 30, 20, 10);
		glClearColor(0, 0.5f * (float)(i + 1), 0, 1);
		glClear(GL_COLOR_BUFFER_BIT);
		glDisable(GL_SCISSOR_TEST);
		glPixelZoom(4, 4);
		glRasterPos2f((float)i - 0.9f, -0.9f);
		glDrawPixels(2, 2, GL_RGB, GL_UNSIGNED_BYTE, pixels);
		glRasterPos2f((float)i - 0.6f, -0.9f);
		glCopyPixels(24, 18, 4, 2, GL_COLOR);
		glPixelZoom(1, 1);
		glEndConditionalRenderNV();
	}
}

static void lists_and_arrays(void)
{
	static const float at[4][2] = { { -0.9f, 0.3f }, { -0.4f, 0.3f }, { -0.4f, 0.9f }, { -0.9f, 0.9f } };
	const GLuint list = glGenLists(1);

	glNewList(list, GL_COMPILE);
	glColor3f(0, 0, 1);
	rectangle(0.4f, 0.4f, 0);
	glEndList();
	for (int i = 0; i < 2; i++) {
		glBeginConditionalRenderNV(ask(i), GL_QUERY_WAIT_NV);
		glCallList(list);
		glColor3f((float)i, 1, 0);
		glEnableClientState(GL_VERTEX_ARRAY);
		glVertexPointer(2, GL_FLOAT, 0, at);
		glDrawArrays(GL_QUADS, 0, 4);
		glDisableClientState(GL_VERTEX_ARRAY);
		glEndConditionalRenderNV();
	}
}

/* An inverted condition, and one with another query inside: that query counts nothing. */
static void inverted(void)
{
	GLuint inner;

	for (int i = 0; i < 2; i++) {
		glBeginConditionalRender(ask(i), GL_QUERY_WAIT_INVERTED);
		glColor3f((float)i, 0.4f, 1);
		rectangle((float)i - 0.9f, 0.4f, 0);
		inner = ask(1);
		glEndConditionalRender();
		glBeginConditionalRenderNV(inner, GL_QUERY_WAIT_NV);
		rectangle((float)i - 0.9f, -0.9f, 0);
		glEndConditionalRenderNV();
	}
}

int main(void)
{
	static void (*const frames[])(void) = { draws, clears_and_pixels, lists_and_arrays, inverted };

	open_window();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), before);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
