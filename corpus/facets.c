/*
 * A ball and a die above a floor, lit by a lamp. The ball is made of flat faces, as in many programs that save normals:
 *
 *   --by faces      each face has its own normal (default)
 *   --by clockwise  the same, with faces wound the other way
 *   --by flat       glShadeModel(GL_FLAT)
 *   --by round      normals of a round ball
 *
 *   cc -o facets corpus/facets.c -lglut -lGLU -lGL -lm
 */
#include <math.h>

#include "program.h"

enum { AROUND = 24, DOWN = 16 };

static int is_by(const char *how)
{
	return program.by && strcmp(program.by, how) == 0;
}

static void init(void)
{
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_CULL_FACE);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_COLOR_MATERIAL);
	glLightfv(GL_LIGHT0, GL_DIFFUSE, (const float[]){ 0.9f, 0.85f, 0.8f, 1 });
	glClearColor(0.2f, 0.25f, 0.3f, 1);
	program_perspective(45, 0.5, 60);
}

/** A point on the unit ball, by steps around and down. */
static void place(float around, float down, float out[3])
{
	const float turn = around * 6.2831853f / AROUND, fall = down * 3.1415927f / DOWN;

	out[0] = cosf(turn) * sinf(fall);
	out[1] = cosf(fall);
	out[2] = -sinf(turn) * sinf(fall);
}

static void corner(float around, float down)
{
	float at[3];

	place(around, down, at);
	if (is_by("flat") || is_by("round"))
		glNormal3fv(at);
	glVertex3fv(at);
}

static void draw_ball(void)
{
	const float turned = is_by("clockwise") ? 1 : 0;
	float middle[3];

	glFrontFace(turned ? GL_CW : GL_CCW);
	glBegin(GL_QUADS);
	for (int down = 0; down < DOWN; down++)
		for (int around = 0; around < AROUND; around++) {
			const float u = (float)around, v = (float)down;

			place(u + 0.5f, v + 0.5f, middle);
			glNormal3fv(middle);
			corner(u, v);
			corner(u + turned, v + 1 - turned);
			corner(u + 1, v + 1);
			corner(u + 1 - turned, v + turned);
		}
	glEnd();
	glFrontFace(GL_CCW);
}

static void draw(void)
{
	const float turn = program_moved(program.animate_camera, 0.05f);

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	gluLookAt(4 * sinf(turn), 1.5, 4.5 * cosf(turn), 0, 0, 0, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ -3, 4, 3, 1 });
	glShadeModel(GL_SMOOTH);
	glColor3f(0.6f, 0.6f, 0.55f);
	glNormal3f(0, 1, 0);
	glBegin(GL_QUADS);
	glVertex3f(-6, -1, 6);
	glVertex3f(6, -1, 6);
	glVertex3f(6, -1, -6);
	glVertex3f(-6, -1, -6);
	glEnd();
	glColor3f(0.3f, 0.45f, 0.75f);
	glPushMatrix();
	glTranslatef(1.7f, -0.5f, -0.3f);
	glRotatef(30, 0, 1, 0);
	glutSolidCube(1);
	glPopMatrix();
	glColor3f(0.8f, 0.45f, 0.3f);
	glShadeModel(is_by("flat") ? GL_FLAT : GL_SMOOTH);
	draw_ball();
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "facets", init, draw);
	return 0;
}
