/*
 * One second of pictures that are a function of time, at a given rate. A camera walks and turns in a room with a
 * spinning box, a box that carries a lamp, a waving flag (animated by the program), an object that the camera carries,
 * and a row of digits over the picture. There is a cut at 0.5 s. Recorded by test_moments.py.
 */
#include <math.h>

#include "tests/trace/window.h"

#define SECONDS 1.0

static void quad(const float corner[4][3])
{
	const float a[3] = { corner[1][0] - corner[0][0], corner[1][1] - corner[0][1], corner[1][2] - corner[0][2] },
		    b[3] = { corner[3][0] - corner[0][0], corner[3][1] - corner[0][1], corner[3][2] - corner[0][2] };

	glNormal3f(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
	for (int i = 0; i < 4; i++)
		glVertex3fv(corner[i]);
}

static void box(float x, float y, float z)
{
	glBegin(GL_QUADS);
	for (int axis = 0; axis < 3; axis++)
		for (int side = -1; side <= 1; side += 2) {
			const float size[3] = { x, y, z };
			float corner[4][3];

			for (int i = 0; i < 4; i++) {
				const int turn = side > 0 ? i : 3 - i;

				corner[i][axis] = (float)side * size[axis];
				corner[i][(axis + 1) % 3] = (turn == 1 || turn == 2 ? 1.0f : -1.0f) * size[(axis + 1) % 3];
				corner[i][(axis + 2) % 3] = (turn >= 2 ? 1.0f : -1.0f) * size[(axis + 2) % 3];
			}
			quad(corner);
		}
	glEnd();
}

static void flag(float time)
{
	glBegin(GL_QUADS);
	for (int i = 0; i < 12; i++) {
		const float x[2] = { (float)i / 12, (float)(i + 1) / 12 };
		const float z[2] = { 0.15f * sinf(9 * x[0] - 6 * time), 0.15f * sinf(9 * x[1] - 6 * time) };

		quad((const float[4][3]){ { x[0], 0, z[0] }, { x[1], 0, z[1] }, { x[1], 0.6f, z[1] }, { x[0], 0.6f, z[0] } });
	}
	glEnd();
}

static void color(float r, float g, float b)
{
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, (const float[]){ r, g, b, 1 });
}

static void look_around(float time)
{
	const float turn = time < 0.5f ? 25 * time : 180 + 25 * time;

	glRotatef(turn, 0, 1, 0);
	glTranslatef(0.8f * sinf(time), -0.6f, -0.5f * time);
}

static float lamp_place(float time)
{
	return 2 * time - 0.8f;
}

/* Called before drawing, because OpenGL transforms light positions when they are set. */
static void lights(float time)
{
	glPushMatrix();
	look_around(time);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 1.5f, 2.0f, -1, 1 });
	glLightfv(GL_LIGHT1, GL_POSITION, (const float[]){ lamp_place(time), 0.6f, -3.3f, 1 });
	glPopMatrix();
}

static void room(float time)
{
	color(0.6f, 0.6f, 0.65f);
	glPushMatrix();
	glTranslatef(0, -0.55f, 0);
	box(6, 0.05f, 6);
	glPopMatrix();
	for (int i = 0; i < 8; i++) {
		glPushMatrix();
		glRotatef(45 * (float)i, 0, 1, 0);
		glTranslatef(0, 0.5f, -5);
		color(0.3f + 0.08f * (float)i, 0.5f, 0.9f - 0.09f * (float)i);
		box(0.8f, 1, 0.2f);
		glPopMatrix();
	}
	glPushMatrix();
	glTranslatef(-0.6f, 0, -3);
	glRotatef(170 * time, 0.3f, 1, 0.1f);
	color(0.9f, 0.5f, 0.2f);
	box(0.35f, 0.35f, 0.35f);
	glPopMatrix();
	glPushMatrix();
	glTranslatef(lamp_place(time), 0.2f, -3.6f);
	color(0.9f, 0.9f, 0.3f);
	box(0.1f, 0.1f, 0.1f);
	glPopMatrix();
	glPushMatrix();
	glTranslatef(0.3f, -0.3f, -2.6f);
	color(0.8f, 0.2f, 0.2f);
	flag(time);
	glPopMatrix();
}

static void numbers(int number)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, window_size[0], 0, window_size[1], -1, 1);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glDisable(GL_LIGHTING);
	glDisable(GL_DEPTH_TEST);
	glColor3f(1, 1, 1);
	glBegin(GL_QUADS);
	for (int i = 0; i < 8; i++) {
		const float x = 8 + 12 * (float)i, high = number / 4 >> i & 1 ? 10 : 5;

		glVertex2f(x, 6);
		glVertex2f(x + 8, 6);
		glVertex2f(x + 8, 6 + high);
		glVertex2f(x, 6 + high);
	}
	glEnd();
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
}

int main(int argc, char **argv)
{
	const int fps = argc > 1 ? atoi(argv[1]) : 15, numbered = 60 / fps;

	open_lit_window(320, 240);
	glEnable(GL_LIGHT1);
	glEnable(GL_NORMALIZE);
	glLightfv(GL_LIGHT1, GL_DIFFUSE, (const float[]){ 0.5f, 0.5f, 0.1f, 1 });
	glLightf(GL_LIGHT1, GL_LINEAR_ATTENUATION, 1);
	for (int frame = 0; frame <= (int)(SECONDS * fps); frame++) {
		const float time = (float)frame / (float)fps;

		glClearColor(0.1f + 0.2f * time, 0.2f, 0.4f, 1);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glMatrixMode(GL_PROJECTION);
		glLoadIdentity();
		glFrustum(-0.1333, 0.1333, -0.1, 0.1, 0.2, 30);
		glMatrixMode(GL_MODELVIEW);
		glLoadIdentity();
		lights(time);
		glPushMatrix();
		glTranslatef(0.25f, -0.2f, -0.8f);
		glRotatef(30, 1, 1, 0);
		color(0.2f, 0.8f, 0.4f);
		box(0.06f, 0.04f, 0.06f);
		glPopMatrix();
		look_around(time);
		room(time);
		numbers(frame * numbered);
		end_frame();
	}
	return 0;
}
