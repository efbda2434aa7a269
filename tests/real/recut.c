/*
 * A hilly ground, tessellated coarsely while the viewer is still; later finely, and differently in each frame. The
 * posts on it never change. Recorded by tests/look/test_unseen.py.
 */
#include <math.h>

#include "tests/trace/window.h"

enum { FRAMES = 16, STANDING = 5, POSTS = 60 };

static float height(float x, float z)
{
	return 0.35f * sinf(x * 1.7f) * cosf(z * 1.3f) + 0.15f * sinf(x * 4.1f + z * 3.3f);
}

static void corner(float x, float z)
{
	const float step = 0.02f, y = height(x, z);

	glNormal3f((y - height(x + step, z)) / step, 1, (y - height(x, z + step)) / step);
	glVertex3f(x, y, z);
}

/* `across` squares wide and twice as many deep, from z = 2 to z = -14. */
static void ground(int across)
{
	const float size = 8.0f / (float)across;

	glBegin(GL_QUADS);
	for (int j = 0; j < 2 * across; j++)
		for (int i = 0; i < across; i++) {
			const float x = -4 + size * (float)i, z = 2 - size * (float)j;

			corner(x, z);
			corner(x + size, z);
			corner(x + size, z - size);
			corner(x, z - size);
		}
	glEnd();
}

static void post(int number)
{
	const float x = -3.5f + (float)(number * 7 % POSTS) * 0.117f, z = -13 + (float)number * 0.2f;
	const float tall = 2 + 0.1f * (float)(number % 7), wide = 0.3f;

	glPushMatrix();
	glTranslatef(x, height(x, z), z);
	glBegin(GL_QUADS);
	for (int side = -1; side <= 1; side += 2) {
		glNormal3f(0, 0, (float)side);
		glVertex3f(-wide * (float)side, 0, 0.05f * (float)side);
		glVertex3f(wide * (float)side, 0, 0.05f * (float)side);
		glVertex3f(wide * (float)side, tall, 0.05f * (float)side);
		glVertex3f(-wide * (float)side, tall, 0.05f * (float)side);
	}
	glEnd();
	glPopMatrix();
}

int main(void)
{
	open_lit_window(160, 120);
	glEnable(GL_NORMALIZE);
	for (int frame = 0; frame < FRAMES; frame++) {
		const int moved = frame < STANDING ? 0 : frame - STANDING + 1;

		begin_view();
		glRotatef(12, 1, 0, 0);
		glTranslatef(0, -1.1f, 0.12f * (float)moved - 1);
		glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 1, 6, 2, 0 });
		ground(frame < STANDING ? 9 : 40 + moved);
		for (int i = 0; i < POSTS; i++)
			post(i);
		end_frame();
	}
	return 0;
}
