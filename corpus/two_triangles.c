/*
 * Two white triangles on black: the first program to record. Unlit, immediate mode; any difference between the traced
 * and the rasterized frame is an error of the recording or of the coverage rule.
 *
 *   cc -o two_triangles corpus/two_triangles.c -lglut -lGLU -lGL -lm
 */
#include "program.h"

static void init(void)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(-4, 4, -3, 3, -1, 1);
	glMatrixMode(GL_MODELVIEW);
	glColor3f(1, 1, 1);
}

static void draw(void)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	if (program.animate_camera)
		glRotatef((float)program_frame, 0, 0, 1);
	glBegin(GL_TRIANGLES);
	glVertex2f(-3.0f, -2.0f);
	glVertex2f(-0.5f, -2.0f);
	glVertex2f(-1.75f, 1.5f);
	glVertex2f(0.5f, -1.0f);
	glVertex2f(3.0f, -1.5f);
	glVertex2f(2.25f, 2.0f);
	glEnd();
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "two triangles", init, draw);
	return 0;
}
