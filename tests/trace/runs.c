/* Immediate mode that repeats: runs that may become a list in the trace only, and runs that may not. */
#include <stdio.h>

#include "window.h"

enum { CORNERS = 12 };

/* A fan with enough calls to be worth a list. */
static void fan(float shade)
{
	glBegin(GL_TRIANGLE_FAN);
	for (int i = 0; i < CORNERS; i++) {
		glColor3f(shade, (float)i / CORNERS, 0);
		glVertex2f(i & 1 ? 0.5f : -0.5f, (float)i / CORNERS - 0.5f);
	}
	glEnd();
}

/* With a call inside that no run may contain: everything is written unchanged. */
static void interrupted(void)
{
	glBegin(GL_TRIANGLE_FAN);
	for (int i = 0; i < CORNERS; i++) {
		glColor4ub(1, 2, 3, (unsigned char)i);
		glVertex2i(i, 1);
		if (i == 5)
			glEvalCoord1f(0.5f);
	}
	glEnd();
}

int main(void)
{
	unsigned list;

	open_window();
	fan(0.25f); /* first seen: a list at once, while few have been made in vain */
	fan(0.25f);
	interrupted();
	interrupted();
	fan(0.75f);
	glBegin(GL_POINTS); /* too short */
	glVertex2f(0, 0);
	glEnd();
	end_frame();

	/* A list of the program's own keeps its calls and its name. */
	list = glGenLists(2);
	printf("lists from %u\n", list);
	glNewList(list, GL_COMPILE_AND_EXECUTE);
	fan(0.25f);
	glEndList();
	expect(!glIsList(0xFFFFFF), "the program sees no list of the recorder's");
	fan(0.25f);
	glCallList(list);
	fan(0.75f);

	/* The program uses one of the names reserved for such lists: no more are made. */
	glNewList(0xF00001, GL_COMPILE);
	glEndList();
	fan(0.5f);
	fan(0.5f);

	/* From here on vertices depend on an edge flag set outside their run. */
	glEdgeFlag(GL_FALSE);
	fan(0.25f);
	expect(glGetError() == GL_NO_ERROR, "no error");
	end_frame();
	return 0;
}
