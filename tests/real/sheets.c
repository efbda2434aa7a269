/*
 * Sheets that must not block light, and shadows that the program draws itself. tests/look/test_sheets.py records one
 * kind of frame at a time:
 *
 *   window  a box on a floor under a lamp behind the viewer: alone; after a sheet that covers the window, drawn with
 *           identity matrices, which writes the clear depth; after one in pixel coordinates, without depth;
 *           before one
 *           in pixel coordinates in front of everything, whose fragments all fail the alpha test
 *   iso     the same in parallel projection, with a lamp above: alone; after a sheet in another parallel projection,
 *           nearer than the box
 *   unseen  the box alone; under sheets that are culled on both sides, always fail the depth test, write neither
 *   colour
 *           nor depth, or are drawn under GL_EQUAL where no pixel has their depth
 *   drawn   a box on a floor: alone; with its shadow flattened onto the floor, from the light; from another position
 *   leaning bodies whose normals lean towards a light that their faces turn away from: a box with one normal per
 *   face;
 *           one with the normals of a ball; a coarse ball; then the first behind a board that blocks the
 *           light
 *   steps   boards that face the viewer one behind the other, each visible in a pixel or two; no light
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
	static const float faces[6][3] = { { 0, 0, 1 },   { 90, 1, 0 }, { 180, 1, 0 },
		                           { 270, 1, 0 }, { 90, 0, 1 }, { -90, 0, 1 } };
	static const float face[4][3] = {
		{ -0.5f, -0.5f, 0.5f }, { 0.5f, -0.5f, 0.5f }, { 0.5f, 0.5f, 0.5f }, { -0.5f, 0.5f, 0.5f }
	};

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

/* A square at depth z, from low to high on both axes. */
static void sheet(float low, float high, float z)
{
	const float corners[4][3] = { { low, low, z }, { high, low, z }, { high, high, z }, { low, high, z } };

	glDisable(GL_LIGHTING);
	glColor4f(0, 0, 0, 0.25f);
	quad(corners);
	glEnable(GL_LIGHTING);
}

/* Parallel projection of the window from 0 to size; with 0, the identity. */
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

/* Draw the clear depth, then a sheet that passes only where that depth is. */
static void carved_sheet(void)
{
	glEnable(GL_ALPHA_TEST);
	glAlphaFunc(GL_GREATER, 0.5f);
	glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
	sheet(-1.5f, 1.5f, 0);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	glDisable(GL_ALPHA_TEST);
	glDepthFunc(GL_EQUAL);
	sheet(-1.5f, 1.5f, 0);
	glDepthFunc(GL_LESS);
}

static void draw_unseen(void)
{
	for (int i = 0; i < 6; i++) {
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
		} else if (i == 4) {
			glDepthFunc(GL_EQUAL);
			sheet(-1.5f, 1.5f, 0);
			glDepthFunc(GL_LESS);
		} else if (i == 5) {
			carved_sheet();
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

/* A point of a ball or box around the origin, with a normal between the face's own and `lean`. */
static void corner(const float face[3], const float at[3], const float lean[3], float share)
{
	float n[3];

	for (int k = 0; k < 3; k++)
		n[k] = (1 - share) * face[k] + share * lean[k];
	glNormal3fv(n);
	glVertex3fv(at);
}

/* A box drawn at once. lean: the direction that normals lean to; NULL: that of the corner */
static void leaning_box(const float lean[3], float share)
{
	static const float around[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };

	glBegin(GL_QUADS);
	for (int face = 0; face < 6; face++)
		for (int k = 0; k < 4; k++) {
			const int axis = face / 2, side = face % 2 ? 1 : -1;
			float normal[3] = { 0 }, at[3];

			normal[axis] = (float)side;
			at[axis] = 0.5f * (float)side;
			at[(axis + 1) % 3] = 0.5f * around[side > 0 ? k : 3 - k][0];
			at[(axis + 2) % 3] = 0.5f * around[side > 0 ? k : 3 - k][1];
			corner(normal, at, lean ? lean : at, share);
		}
	glEnd();
}

static void coarse_ball(void)
{
	enum { ROUND = 8, HIGH = 5 };

	glBegin(GL_QUADS);
	for (int i = 0; i < ROUND * HIGH; i++)
		for (int k = 0; k < 4; k++) {
			const float turn = 6.2831853f * (float)(i % ROUND + (k == 1 || k == 2)) / ROUND;
			const float rise = 3.1415927f * ((float)(i / ROUND + (k > 1)) / HIGH - 0.5f);
			const float at[3] = { 0.7f * cosf(rise) * sinf(turn), 0.7f * sinf(rise), 0.7f * cosf(rise) * cosf(turn) };

			corner(at, at, at, 0);
		}
	glEnd();
}

static void draw_leaning(void)
{
	static const float low[4] = { 0.8f, 0.5f, -0.3f, 0 };

	for (int i = 0; i < 4; i++) {
		begin_frame(0, low);
		glEnable(GL_NORMALIZE);
		glColor3f(0.8f, 0.6f, 0.4f);
		glPushMatrix();
		glTranslatef(0, 0, -3);
		if (i == 2)
			coarse_ball();
		else
			leaning_box(i == 1 ? NULL : low, i == 1 ? 1 : 0.6f);
		if (i == 3) {
			glTranslatef(2.4f, 1.5f, -0.9f);
			glScalef(0.1f, 1.5f, 1.5f);
			box();
		}
		glPopMatrix();
		end_frame();
	}
}

static void draw_steps(void)
{
	begin_frame(0, sun);
	glDisable(GL_LIGHTING);
	glPushMatrix();
	glLoadIdentity();
	for (int i = 0; i < 60; i++) {
		const float x = 0.9f - 0.05f * (float)i, z = -2 - 0.05f * (float)i;
		const float corners[4][3] = { { x, -1, z }, { 2, -1, z }, { 2, 1, z }, { x, 1, z } };

		glColor3f(0.3f, 0.5f, 0.9f);
		quad(corners);
	}
	glPopMatrix();
	end_frame();
}

int main(int argc, char **argv)
{
	static const struct {
		const char *name;
		void (*draw)(void);
	} kinds[] = { { "window", draw_window }, { "iso", draw_iso }, { "unseen", draw_unseen }, { "drawn", draw_drawn },
	              { "leaning", draw_leaning }, { "steps", draw_steps } };

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
	fprintf(stderr, "usage: sheets window|iso|unseen|drawn|leaning|steps\n");
	return 2;
}
