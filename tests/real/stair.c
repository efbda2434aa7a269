/*
 * A staircase that rises by a third of a step every four frames, and then loses one step. Two boxes on it rise as well,
 * while the viewer turns. Recorded by tests/look/test_unseen.py.
 */
#include "tests/trace/window.h"

#define FRAMES 12

static void box(float x, float y, float z, float size)
{
	glBegin(GL_QUADS);
	for (int axis = 0; axis < 3; axis++)
		for (int side = -1; side <= 1; side += 2) {
			float normal[3] = { 0, 0, 0 };

			normal[axis] = (float)side;
			glNormal3fv(normal);
			for (int i = 0; i < 4; i++) {
				const int turn = side > 0 ? i : 3 - i;
				float p[3];

				p[axis] = (float)side * size;
				p[(axis + 1) % 3] = turn == 1 || turn == 2 ? size : -size;
				p[(axis + 2) % 3] = turn >= 2 ? size : -size;
				glVertex3f(p[0] + x, p[1] + y, p[2] + z);
			}
		}
	glEnd();
}

static void steps(int count, float up)
{
	glBegin(GL_QUADS);
	for (int i = 0; i < count; i++) {
		const float y = up + 0.6f * (float)(i - 4), z = -0.6f * (float)(i - 4);

		glNormal3f(0, 1, 0);
		glVertex3f(-3, y, z);
		glVertex3f(3, y, z);
		glVertex3f(3, y, z - 0.6f);
		glVertex3f(-3, y, z - 0.6f);
		glNormal3f(0, 0, 1);
		glVertex3f(-3, y, z - 0.6f);
		glVertex3f(3, y, z - 0.6f);
		glVertex3f(3, y + 0.6f, z - 0.6f);
		glVertex3f(-3, y + 0.6f, z - 0.6f);
	}
	glEnd();
}

int main(void)
{
	open_lit_window(160, 120);
	for (int frame = 0; frame < FRAMES; frame++) {
		const int phase = frame / 4;

		begin_view();
		glTranslatef(0, -0.5f, -6);
		glRotatef(20 + 2 * (float)frame, 0.5f, 1, 0);
		glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 1, 6, 5, 1 });
		steps(10 - phase, 0.2f * (float)phase);
		glPushMatrix();
		glTranslatef(0, 0.2f * (float)phase, 0);
		box(-1, 0.4f, -0.3f, 0.2f);
		box(1, 0.6f, -0.3f, 0.15f);
		glPopMatrix();
		end_frame();
	}
	return 0;
}
