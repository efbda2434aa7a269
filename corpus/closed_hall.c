/*
 * A closed hall, lit from outside by two directional lights. OpenGL has no shadows, so their light passes walls and
 * ceiling, and programs of the time lit rooms this way. Traced literally, the whole hall lies in the ceiling's shadow.
 *
 *   cc -o closed_hall corpus/closed_hall.c -lglut -lGLU -lGL -lm
 */
#include <math.h>

#include "program.h"

static const float half_width = 5, height = 5, half_length = 9;

static void init(void)
{
	static const float first[4] = { 0.75f, 0.7f, 0.68f, 1 }, second[4] = { 0.2f, 0.22f, 0.3f, 1 };

	glEnable(GL_DEPTH_TEST);
	glEnable(GL_CULL_FACE);
	glEnable(GL_NORMALIZE);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_LIGHT1);
	glEnable(GL_COLOR_MATERIAL);
	glLightfv(GL_LIGHT0, GL_DIFFUSE, first);
	glLightfv(GL_LIGHT1, GL_DIFFUSE, second);
	program_perspective(60, 0.1, 50);
}

/** A wall by its corner and two edges; it faces along right x up. */
static void wall(const float at[3], const float right[3], const float up[3])
{
	glNormal3f(right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2],
	           right[0] * up[1] - right[1] * up[0]);
	glVertex3fv(at);
	glVertex3f(at[0] + right[0], at[1] + right[1], at[2] + right[2]);
	glVertex3f(at[0] + right[0] + up[0], at[1] + right[1] + up[1], at[2] + right[2] + up[2]);
	glVertex3f(at[0] + up[0], at[1] + up[1], at[2] + up[2]);
}

static void draw_walls(void)
{
	const float w = half_width, h = height, l = half_length;

	glBegin(GL_QUADS);
	glColor3f(0.6f, 0.5f, 0.4f);
	wall((const float[]){ -w, 0, l }, (const float[]){ 2 * w, 0, 0 }, (const float[]){ 0, 0, -2 * l });
	glColor3f(0.8f, 0.8f, 0.75f);
	wall((const float[]){ -w, h, -l }, (const float[]){ 2 * w, 0, 0 }, (const float[]){ 0, 0, 2 * l });
	glColor3f(0.7f, 0.35f, 0.3f);
	wall((const float[]){ -w, 0, l }, (const float[]){ 0, 0, -2 * l }, (const float[]){ 0, h, 0 });
	glColor3f(0.35f, 0.55f, 0.4f);
	wall((const float[]){ w, 0, -l }, (const float[]){ 0, 0, 2 * l }, (const float[]){ 0, h, 0 });
	glColor3f(0.7f, 0.7f, 0.8f);
	wall((const float[]){ -w, 0, -l }, (const float[]){ 2 * w, 0, 0 }, (const float[]){ 0, h, 0 });
	wall((const float[]){ w, 0, l }, (const float[]){ -2 * w, 0, 0 }, (const float[]){ 0, h, 0 });
	glEnd();
}

static void draw_pillar(float x, float z)
{
	glPushMatrix();
	glTranslatef(x, height / 2, z);
	glScalef(0.7f, height, 0.7f);
	glutSolidCube(1);
	glPopMatrix();
}

static void draw(void)
{
	float turn = program_moved(program.animate_camera, 0.03f);

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	gluLookAt(3 * sinf(turn), 2.2, 8.5, 0, 1.8, 0, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 0.5f, 0.8f, 0.6f, 0 });
	glLightfv(GL_LIGHT1, GL_POSITION, (const float[]){ -0.8f, -0.3f, 0.4f, 0 });
	draw_walls();
	glColor3f(0.8f, 0.75f, 0.6f);
	for (int i = 0; i < 3; i++) {
		draw_pillar(-3, 4 - 4 * (float)i);
		draw_pillar(3, 4 - 4 * (float)i);
	}
	glColor3f(0.75f, 0.6f, 0.2f);
	glTranslatef(0, 0.75f, 1);
	glRotatef(30, 0, 1, 0);
	glutSolidCube(1.5);
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "closed hall", init, draw);
	return 0;
}
