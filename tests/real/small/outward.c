/* Vertices far out, with a w that is zero or nearly zero. One frame each; recorded by test_small.py. */
#include "tests/trace/window.h"

static void before(void)
{
	glEnable(GL_DEPTH_TEST);
	glDisable(GL_LIGHTING);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.1, 0.1, -0.1, 0.1, 0.1, 60);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glColor3f(0.3f, 0.6f, 0.9f);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static void far_out(void)
{
	static const float far[] = { 1e14f, 1e15f, 1e16f, 1e17f, 9e17f };

	for (int i = 0; i < 5; i++) {
		glBegin(GL_TRIANGLES);
		glVertex3f(-4, (float)(i - 3), -5);
		glVertex3f(far[i], (float)(i - 3), -5);
		glColor3f(0.2f * (float)i, 0.5f, 0.1f);
		glVertex3f(i % 2 ? far[i] : -4, (float)(i - 3) + 0.8f, -5);
		glEnd();
	}
}

static void hardly_any_w(void)
{
	static const float w[] = { 1e-15f, 1e-19f, 1e-22f, 1e-30f, 1e12f };

	for (int i = 0; i < 5; i++) {
		const float y = 2 * (float)(i - 2);

		glBegin(GL_TRIANGLES);
		glVertex4f(-4 * w[i], y * w[i], -5 * w[i], w[i]);
		glVertex4f(4 * w[i], y * w[i], -5 * w[i], w[i]);
		glColor3f(1, 0.2f * (float)i, 0);
		glVertex4f(0, (y + 1.5f) * w[i], -5 * w[i], w[i]);
		glEnd();
	}
}

/* The way z-fail shadow volumes are closed. */
static void without_w(void)
{
	for (int i = 0; i < 3; i++) {
		const float x = 1.5f * (float)(i - 1);

		glBegin(GL_QUADS);
		glVertex3f(x - 0.5f, -1, -3);
		glVertex3f(x + 0.5f, -1, -3);
		glColor3f(1, 0, 0);
		glVertex4f(x + 0.5f, (float)(i - 1), i == 1 ? 2 : -2, i == 2 ? -0.4f : 0);
		glVertex4f(x - 0.5f, (float)(i - 1), i == 1 ? 2 : -2, i == 2 ? -0.4f : 0);
		glEnd();
	}
}

/* Vertices with different w: the middle of an edge in clip space is not its middle in object space. */
static void mixed_w(void)
{
	glBegin(GL_TRIANGLES);
	glVertex4f(-3, -3, -4, 1);
	glVertex4f(12, -12, -16, 4);
	glColor3f(1, 0, 0);
	glVertex4f(0, 1.5f, -2.5f, 0.5f);
	glEnd();
}

/* A ground that reaches the horizon, and the shadow of a board on it. */
static void ground(void)
{
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 0, 5, -5, 1 });
	glNormal3f(0, 1, 0);
	glBegin(GL_TRIANGLES);
	glVertex3f(0, -1, 2);
	glVertex4f(1, 0, -1, 0);
	glVertex4f(-1, 0, -1, 0);
	glEnd();
	glBegin(GL_QUADS);
	glVertex3f(-1, 0, -4);
	glVertex3f(1, 0, -4);
	glVertex3f(1, 0, -6);
	glVertex3f(-1, 0, -6);
	glEnd();
}

int main(void)
{
	static void (*const frames[])(void) = {
		far_out, hardly_any_w, without_w, mixed_w, ground,
	};

	open_window();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), before);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
