/*
 * Quads and line loops that repeat from frame to frame, which drivers may draw differently from lists than in immediate
 * mode. With the argument "back": lit faces whose colour material applies to the back only, set inside one run and
 * before the next.
 */
#include "window.h"

enum { FRAMES = 6, CORNERS = 12 };

static void run(GLenum mode, float size)
{
	static const float x[4] = { -1, 1, 1, -1 }, y[4] = { -1, -1, 1, 1 };

	glBegin(mode);
	for (int i = 0; i < CORNERS; i++) {
		float shrink = size * (1 - 0.25f * (float)(i / 4));

		glColor3f((float)i / CORNERS, x[i % 4], y[i % 4]);
		glVertex3f(shrink * x[i % 4], shrink * y[i % 4], -0.1f * (float)i);
	}
	glEnd();
}

static void light(void)
{
	static const float position[4] = { 1, 1, 1, 0 };

	glLightfv(GL_LIGHT0, GL_POSITION, position);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
	glColorMaterial(GL_BACK, GL_DIFFUSE);
	glEnable(GL_COLOR_MATERIAL);
	glEnable(GL_LIGHT0);
	glEnable(GL_LIGHTING);
}

/* From front and behind, with a colour per vertex or for all. */
static void lit_faces(void)
{
	for (int side = -1; side <= 1; side += 2)
		for (int one = 0; one < 2; one++) {
			float left = (float)one - 1, bottom = 0.5f * (float)side - 0.5f;

			glNormal3f(0, 0, (float)side);
			glColor3f(0.9f, 0.8f, 0.3f);
			glBegin(GL_TRIANGLE_FAN);
			for (int i = 0; i < 8; i++) {
				if (!one)
					glColor3f(0.2f, 0.1f * (float)i, 0.4f);
				glVertex2f(left + 0.1f * (float)i, bottom + (i % 2 ? 0.8f : 0.1f) + 0.01f * (float)i);
			}
			glEnd();
		}
}

int main(int argc, char **argv)
{
	int back = argc > 1 && strcmp(argv[1], "back") == 0;

	open_window();
	if (back)
		light();
	glMatrixMode(GL_PROJECTION);
	glFrustum(-0.5, 0.5, -0.4, 0.4, 1, 10);
	glMatrixMode(GL_MODELVIEW);
	glEnable(GL_DEPTH_TEST);
	for (int frame = 0; frame < FRAMES; frame++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glLoadIdentity();
		glTranslatef(0, 0, -3);
		glRotatef(10.0f * (float)frame, 1, 1, 0);
		if (back) {
			lit_faces();
		} else {
			run(GL_QUADS, 1);
			run(GL_LINE_LOOP, 1.2f);
		}
		end_frame();
	}
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
