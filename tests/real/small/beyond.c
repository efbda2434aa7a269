/*
 * Draws of more vertices than their buffer objects hold: Mesa reads zeros there. A frame each; recorded by
 * test_small.py.
 */
#include "tests/trace/window.h"

static const float corners[4][9] = {
	{ -0.9f, -0.8f, 0.2f, 0.9f, 0.2f, 0.2f, 1, 0.1f, 0.2f }, { -0.9f, 0.7f, 0.2f, 0.2f, 0.9f, 0.2f, 1, 0.3f, 0.2f },
	{ -0.3f, -0.8f, 0.2f, 0.2f, 0.2f, 0.9f, 1, 0.1f, 0.9f }, { 0.6f, 0.9f, 0.2f, 0.9f, 0.9f, 0.2f, 1, 0.7f, 0.8f },
};

static void point_at(GLint color_size, GLint position_size)
{
	glVertexPointer(position_size, GL_FLOAT, sizeof(*corners), NULL);
	glColorPointer(color_size, GL_FLOAT, sizeof(*corners), (void *)(3 * sizeof(float)));
}

static void arrays(void)
{
	point_at(3, 3);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 8);
}

static void indices(void)
{
	static const GLushort elements[] = { 0, 1, 9, 1, 3, 60000, 2, 3, 0 };

	point_at(3, 2);
	glDrawElements(GL_TRIANGLES, 9, GL_UNSIGNED_SHORT, elements);
}

static void four_colors(void)
{
	point_at(4, 3);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glDrawArrays(GL_TRIANGLE_FAN, 0, 6);
	glDisable(GL_BLEND);
}

static void all_beyond(void)
{
	point_at(3, 3);
	glDrawArrays(GL_TRIANGLES, 2, 300000);
	glPointSize(5);
	glDrawArrays(GL_POINTS, 7, 1);
	glPointSize(1);
}

static void shorter_colors(void)
{
	GLuint few;

	point_at(3, 3);
	glGenBuffers(1, &few);
	glBindBuffer(GL_ARRAY_BUFFER, few);
	glBufferData(GL_ARRAY_BUFFER, 2 * 3 * sizeof(float), corners[3], GL_STATIC_DRAW);
	glColorPointer(3, GL_FLOAT, 0, NULL);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

int main(void)
{
	static void (*const frames[])(void) = { arrays, indices, four_colors, all_beyond, shorter_colors };
	GLuint buffer;

	open_window();
	glClearColor(0.1f, 0.2f, 0.3f, 1);
	glGenBuffers(1, &buffer);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	for (int i = 0; i < 5; i++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glBindBuffer(GL_ARRAY_BUFFER, buffer);
		glBufferData(GL_ARRAY_BUFFER, sizeof(corners), corners, GL_STATIC_DRAW);
		frames[i]();
		end_frame();
	}
	return 0;
}
