/*
 * Differences between Mesa and OpenGL that a report lists: colour material for back sides only, where other panels use
 * it for both sides. Recorded by test_known.py.
 */
#include "panels.h"

static void tracked(int i)
{
	static const GLenum modes[5] = { GL_EMISSION, GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_AMBIENT_AND_DIFFUSE };
	static const float position[4] = { 0.3f, 0.2f, -1, 0 };

	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, position);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
	glColorMaterial(i / 5 ? GL_FRONT_AND_BACK : GL_BACK, modes[i % 5]);
	glEnable(GL_COLOR_MATERIAL);
	glFrontFace(GL_CW);
}

static void draw_square(int i)
{
	static const float corners[4][2] = { { -0.9f, -0.9f }, { 0.9f, -0.9f }, { 0.9f, 0.9f }, { -0.9f, 0.9f } };

	(void)i;
	glBegin(GL_QUADS);
	for (int c = 0; c < 4; c++) {
		glColor3f(0.3f + 0.2f * (float)c, 0.9f - 0.2f * (float)c, 0.5f);
		glNormal3f(0, 0, 1);
		glVertex2fv(corners[c]);
	}
	glEnd();
}

int main(void)
{
	static const struct table tables[] = { { 10, tracked, draw_square } };

	DRAW_TABLES(tables, NULL);
	return 0;
}
