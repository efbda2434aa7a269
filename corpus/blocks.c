/*
 * Low-poly shapes with smooth normals on a plate, in low light. Where the light grazes, the shapes' flat faces block
 * light that their normals face. That border between light and shade is the shadow terminator.
 *
 *   cc -o blocks corpus/blocks.c -lglut -lGLU -lGL -lm
 */
#include <math.h>

#include "program.h"

static void init(void)
{
	glClearColor(0.55f, 0.65f, 0.75f, 1);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_CULL_FACE);
	glEnable(GL_NORMALIZE);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	program_perspective(40, 1, 50);
}

/** A cube from -1 to 1. Each corner has one normal, along its diagonal. */
static void draw_block(void)
{
	static const int faces[6][4] = { { 0, 1, 3, 2 }, { 4, 6, 7, 5 }, { 0, 4, 5, 1 },
		                         { 2, 3, 7, 6 }, { 0, 2, 6, 4 }, { 1, 5, 7, 3 } };

	glBegin(GL_QUADS);
	for (int f = 0; f < 6; f++)
		for (int i = 0; i < 4; i++) {
			int corner = faces[f][i];
			float x = corner & 4 ? 1 : -1, y = corner & 2 ? 1 : -1, z = corner & 1 ? 1 : -1;

			glNormal3f(x, y, z);
			glVertex3f(x, y, z);
		}
	glEnd();
}

static void draw_plate(void)
{
	glBegin(GL_QUADS);
	glNormal3f(0, 1, 0);
	glVertex3f(-8, -1, 8);
	glVertex3f(8, -1, 8);
	glVertex3f(8, -1, -8);
	glVertex3f(-8, -1, -8);
	glEnd();
}

static void draw(void)
{
	float camera = program_moved(program.animate_camera, 0.05f), light = program_moved(program.animate_light, 0.05f);

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	gluLookAt(9 * sinf(camera), 4, 9 * cosf(camera), 0, 0, 0, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ cosf(light), 0.5f, 0.35f + sinf(light), 0 });
	program_color(0.7f, 0.7f, 0.7f);
	draw_plate();
	program_color(0.85f, 0.5f, 0.25f);
	glTranslatef(-2.6f, 0, 0);
	draw_block();
	program_color(0.35f, 0.6f, 0.8f);
	glTranslatef(2.6f, 0, 0.8f);
	glutSolidSphere(1, 10, 6);
	program_color(0.5f, 0.75f, 0.35f);
	glTranslatef(2.6f, -1, -0.8f);
	glRotatef(-90, 1, 0, 0);
	glutSolidCone(1, 2, 7, 3);
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "blocks", init, draw);
	return 0;
}
