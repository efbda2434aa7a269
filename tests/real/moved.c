/*
 * A triangle between a lit floor and the light: first with its vertices in place, then moved by one unit, with a vertex
 * program that moves them back. Recorded by test_moved.py.
 */
#include <string.h>

#include "tests/trace/window.h"

#define TEXT \
	"!!ARBvp1.0\n" \
	"PARAM m[4] = { state.matrix.mvp };\n" \
	"TEMP p;\n" \
	"ADD p, vertex.position, program.local[0];\n" \
	"DP4 result.position.x, m[0], p;\n" \
	"DP4 result.position.y, m[1], p;\n" \
	"DP4 result.position.z, m[2], p;\n" \
	"DP4 result.position.w, m[3], p;\n" \
	"MOV result.color, vertex.color;\n" \
	"END\n"

static void floor_below(void)
{
	glEnable(GL_LIGHTING);
	glBegin(GL_QUADS);
	glNormal3f(0, 1, 0);
	glVertex3f(-2, 0, -2);
	glVertex3f(-2, 0, 2);
	glVertex3f(2, 0, 2);
	glVertex3f(2, 0, -2);
	glEnd();
	glDisable(GL_LIGHTING);
}

/* All numbers are sums of eighths, so that both ways give exactly the same result. */
static void triangle(float x, float y, float z)
{
	glColor3f(0.8f, 0.5f, 0.2f);
	glBegin(GL_TRIANGLES);
	glVertex3f(-0.75f - x, 0.875f - y, -0.625f - z);
	glVertex3f(0.125f - x, 1.125f - y, 0.75f - z);
	glVertex3f(0.875f - x, 1 - y, -0.5f - z);
	glEnd();
}

int main(void)
{
	static const float above[4] = { 0.5f, 4, 0.5f, 1 };

	window_size[0] = 240;
	window_size[1] = 180;
	open_window();
	glProgramStringARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, (GLsizei)strlen(TEXT), TEXT);
	glProgramLocalParameter4fARB(GL_VERTEX_PROGRAM_ARB, 0, 1, -0.5f, 0.25f, 0);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHT0);
	glMatrixMode(GL_PROJECTION);
	glFrustum(-0.5, 0.5, -0.5, 0.5, 1, 20);
	glMatrixMode(GL_MODELVIEW);
	for (int frame = 0; frame < 2; frame++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glLoadIdentity();
		glTranslatef(0, -0.5f, -5);
		glRotatef(35, 1, 0, 0);
		glLightfv(GL_LIGHT0, GL_POSITION, above);
		floor_below();
		if (frame) {
			glEnable(GL_VERTEX_PROGRAM_ARB);
			triangle(1, -0.5f, 0.25f);
			glDisable(GL_VERTEX_PROGRAM_ARB);
		} else {
			triangle(0, 0, 0);
		}
		end_frame();
	}
	return 0;
}
