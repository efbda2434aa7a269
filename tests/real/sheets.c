/*
 * Sheets that are in nobody's light, and shadows that the program draws itself. tests/look/test_sheets.py records one
 * kind of frames at a time:
 *
 *   window  a box on a floor under a lamp behind the viewer: alone; after a sheet over all of the window by no matrices at
 *           all, which writes the depth of the clear; after one in pixels, without depth; before one in pixels in front
 *           of all, of which nothing passes the alpha test
 *   iso     the same in parallel projection, a lamp above: alone; after a sheet of another parallel projection, nearer than it
 *   unseen  the box alone; under sheets that are culled on both sides, fail the depth test always, or have no colour
 *           and leave no depth
 *   drawn   a box on a floor: alone; with its shadow flattened onto the floor from where the light is; from elsewhere
 */
#include "tests/trace/window.h"

#include <math.h>

static const float sun[4] = { 0.5f, 1, 0.4f, 0 }, elsewhere[4] = { -0.7f, 1, 0.2f, 0 };
static const float behind[4] = { 2, 1.2f, 4, 1 }, above[4] = { 0.5f, 3, 2, 1 };

static void quad(const float corners[4][3])
{
	glBegin(GL_QUADS);
	for (int k = 0; k < 4; k++)
		glVertex3fv(corners[k]);
	glEnd();
}

static void floor_below(void)
{
	static const float corners[4][3] = { { -6, -1, -12 }, { -6, -1, 0 }, { 6, -1, 0 }, { 6, -1, -12 } };

	glColor3f(0.8f, 0.7f, 0.6f);
	glNormal3f(0, 1, 0);
	quad(corners);
}

static void box(void)
{
	static const float faces[6][3] = { { 0, 0, 1 }, { 90, 1, 0 }, { 180, 1, 0 }, { 270, 1, 0 }, { 90, 0, 1 }, { -90, 0, 1 } };
	static const float face[4][3] = { { -0.5f, -0.5f, 0.5f }, { 0.5f, -0.5f, 0.5f }, { 0.5f, 0.5f, 0.5f }, { -0.5f, 0.5f, 0.5f } };

	for (int k = 0; k < 6; k++) {
		glPushMatrix();
		glRotatef(faces[k][0], faces[k][1], faces[k][2], 0);
		glNormal3f(0, 0, 1);
		quad(face);
		glPopMatrix();
	}
}

static void upright(void)
{
	glColor3f(0.4f, 0.6f, 0.8f);
	glPushMatrix();
	glTranslatef(0, -0.45f, -5);
	box();
	glPopMatrix();
}

/* The box flattened onto the floor, away from a light at infinity (Blinn 1988, "Me and My (Fake) Shadow"). */
static void flattened(const float light[4])
{
	const float y = -0.999f;
	const float m[16] = { 1, 0, 0, 0, -light[0] / light[1], 0, -light[2] / light[1], 0, 0, 0, 1, 0,
		              y * light[0] / light[1], y, y * light[2] / light[1], 1 };

	glDisable(GL_LIGHTING);
	glColor3f(0.1f, 0.1f, 0.1f);
	glPushMatrix();
	glMultMatrixf(m);
	glTranslatef(0, -0.45f, -5);
	box();
	glPopMatrix();
	glEnable(GL_LIGHTING);
}

static void begin_frame(int is_parallel, const float light[4])
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	if (is_parallel)
		glOrtho(-2.5, 2.5, -2.5, 2.5, 0.1, 40);
	else
		glFrustum(-0.05, 0.05, -0.05, 0.05, 0.1, 40);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glTranslatef(0, 0, is_parallel ? -4 : 0);
	glRotatef(is_parallel ? 35 : 15, 1, 0, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, light);
}

static void world(void)
{
	floor_below();
	upright();
}

/* A square at z, from low to high on both axes. */
static void sheet(float low, float high, float z)
{
	const float corners[4][3] = { { low, low, z }, { high, low, z }, { high, high, z }, { low, high, z } };

	glDisable(GL_LIGHTING);
	glColor4f(0, 0, 0, 0.25f);
	quad(corners);
	glEnable(GL_LIGHTING);
}

/* Parallel projection of the window from 0 to size; 0: identity. */
static void own_matrices(double size)
{
	glMatrixMode(GL_PROJECTION);
	glPushMatrix();
	glLoadIdentity();
	if (size > 0)
		glOrtho(0, size, 0, size, -100, 100);
	glMatrixMode(GL_MODELVIEW);
	glPushMatrix();
	glLoadIdentity();
}

static void matrices_back(void)
{
	glMatrixMode(GL_PROJECTION);
	glPopMatrix();
	glMatrixMode(GL_MODELVIEW);
	glPopMatrix();
}

static void draw_window(void)
{
	for (int i = 0; i < 4; i++) {
		begin_frame(0, behind);
		if (i == 1) {
			own_matrices(0);
			glDepthFunc(GL_ALWAYS);
			sheet(-1, 1, 1);
			glDepthFunc(GL_LESS);
			matrices_back();
		} else if (i == 2) {
			own_matrices(100);
			glDepthMask(GL_FALSE);
			sheet(0, 100, 0);
			glDepthMask(GL_TRUE);
			matrices_back();
		}
		world();
		if (i == 3) {
			own_matrices(100);
			glEnable(GL_ALPHA_TEST);
			glAlphaFunc(GL_GREATER, 0.5f);
			sheet(0, 100, 50);
			glDisable(GL_ALPHA_TEST);
			matrices_back();
		}
		end_frame();
	}
}

static void draw_iso(void)
{
	for (int i = 0; i < 2; i++) {
		begin_frame(1, above);
		if (i == 1) {
			own_matrices(400);
			glDepthMask(GL_FALSE);
			sheet(0, 400, -1);
			glDepthMask(GL_TRUE);
			matrices_back();
		}
		world();
		end_frame();
	}
}

static void draw_unseen(void)
{
	for (int i = 0; i < 4; i++) {
		begin_frame(0, sun);
		world();
		glPushMatrix();
		glTranslatef(0, 0.4f, -5);
		glRotatef(90, 1, 0, 0);
		if (i == 1) {
			glEnable(GL_CULL_FACE);
			glCullFace(GL_FRONT_AND_BACK);
			sheet(-1.5f, 1.5f, 0);
			glDisable(GL_CULL_FACE);
		} else if (i == 2) {
			glDepthFunc(GL_NEVER);
			sheet(-1.5f, 1.5f, 0);
			glDepthFunc(GL_LESS);
		} else if (i == 3) {
			glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
			glDepthMask(GL_FALSE);
			sheet(-1.5f, 1.5f, 0);
			glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
			glDepthMask(GL_TRUE);
		}
		glPopMatrix();
		end_frame();
	}
}

static void draw_drawn(void)
{
	for (int i = 0; i < 3; i++) {
		begin_frame(0, sun);
		floor_below();
		if (i > 0)
			flattened(i == 1 ? sun : elsewhere);
		upright();
		end_frame();
	}
}

int main(int argc, char **argv)
{
	static const struct {
		const char *name;
		void (*draw)(void);
	} kinds[] = { { "window", draw_window }, { "iso", draw_iso }, { "unseen", draw_unseen }, { "drawn", draw_drawn } };

	window_size[0] = window_size[1] = 100;
	open_window();
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_COLOR_MATERIAL);
	for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++)
		if (argc == 2 && strcmp(argv[1], kinds[i].name) == 0) {
			kinds[i].draw();
			return 0;
		}
	fprintf(stderr, "usage: sheets window|iso|unseen|drawn\n");
	return 2;
}
