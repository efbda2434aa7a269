/*
 * Objects that block light, and others that only seem to. tests/look/test_blocking.py records one kind of frame at a
 * time:
 *
 *   far      a floor around the viewer, 0, 3,000, 30,000 and 100,000 units from the origin; the last one again in
 *            units of 1/10,000
 *   plane    a floor of one quad, of half size 100, 10,000, 100,000; the first and the last one with a box
 *   passes   boxes on a floor under two lights: at once; depth first, then light by light under GL_EQUAL; the same by
 *            a list under GL_LEQUAL, whose first light replaces; boxes by depth, and then blended by their
 *            alpha
 *   sky      a box on a floor: alone; after 18 draws of a sky around the viewer, whose depth is then cleared;
 *            before a depth clear and a hand in front of the light
 *   globe    a lamp over a floor: alone; in an unlit globe of twelve strips; in a lit one of one draw; in a lit box
 *            of six draws; in an unlit globe without normals; beside a globe
 */
#include "tests/trace/window.h"

#include <math.h>

#define TURN 6.2831853f

static const float box_faces[6][4] = { { 0, 0, 1, 0 },   { 90, 0, 1, 0 }, { 180, 0, 1, 0 },
	                               { 270, 0, 1, 0 }, { 90, 1, 0, 0 }, { -90, 1, 0, 0 } };

/* Each face is a separate draw. Boxes float slightly above floors, so that no two surfaces have the same depth. */
static void box(float x, float y, float z, float half)
{
	for (int k = 0; k < 6; k++) {
		glPushMatrix();
		glTranslatef(x, y, z);
		glRotatef(box_faces[k][0], box_faces[k][1], box_faces[k][2], box_faces[k][3]);
		glNormal3f(0, 0, 1);
		glBegin(GL_QUADS);
		glVertex3f(-half, -half, half);
		glVertex3f(half, -half, half);
		glVertex3f(half, half, half);
		glVertex3f(-half, half, half);
		glEnd();
		glPopMatrix();
	}
}

/* Unit tiles around (x, y, z), one unit below. */
static void tiles(float x, float y, float z, float unit)
{
	glNormal3f(0, 1, 0);
	glBegin(GL_QUADS);
	for (int i = -6; i < 6; i++)
		for (int k = -12; k < 0; k++) {
			glVertex3f(x + unit * (float)i, y - unit, z + unit * (float)k);
			glVertex3f(x + unit * (float)i, y - unit, z + unit * (float)(k + 1));
			glVertex3f(x + unit * (float)(i + 1), y - unit, z + unit * (float)(k + 1));
			glVertex3f(x + unit * (float)(i + 1), y - unit, z + unit * (float)k);
		}
	glEnd();
}

static void look(float from_near, float near, float far)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-from_near, from_near, -from_near, from_near, near, far);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glRotatef(12, 1, 0, 0);
}

static void begin_frame(void)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	look(0.05f, 0.1f, 1000);
}

static void lamp(GLenum light, float x, float y, float z, float w)
{
	const GLfloat place[4] = { x, y, z, w };

	glLightfv(light, GL_POSITION, place);
}

/* --- far, plane -------------------------------------------------------------------------------- */

static void draw_far(void)
{
	static const float away[] = { 0, 3e3f, 3e4f, 1e5f };

	for (int i = 0; i < 5; i++) {
		const float unit = i < 4 ? 1 : 1e4f, at = away[i < 4 ? i : 3] * unit;

		begin_frame();
		glScalef(1 / unit, 1 / unit, 1 / unit);
		glTranslatef(-at, -at, -at);
		lamp(GL_LIGHT0, at + unit, at + 4 * unit, at - 4 * unit, 1);
		tiles(at, at, at, unit);
		end_frame();
	}
}

static void draw_plane(void)
{
	static const float half[] = { 1e2f, 1e4f, 1e5f, 1e2f, 1e5f };

	for (int i = 0; i < 5; i++) {
		const float h = half[i];

		begin_frame();
		lamp(GL_LIGHT0, 0.6f, 1, 0.3f, 0);
		glNormal3f(0, 1, 0);
		glBegin(GL_QUADS);
		glVertex3f(-h, -1, -h);
		glVertex3f(-h, -1, h);
		glVertex3f(h, -1, h);
		glVertex3f(h, -1, -h);
		glEnd();
		if (i >= 3)
			box(-0.3f, -0.5f, -3, 0.4f);
		end_frame();
	}
}

/* --- passes -------------------------------------------------------------------------------- */

static void world(void)
{
	glColor4f(0.8f, 0.7f, 0.6f, 0.5f);
	tiles(0, 0, 0, 1);
	glColor4f(0.4f, 0.6f, 0.8f, 0.5f);
	box(-0.5f, -0.49f, -5, 0.5f);
	glColor4f(0.7f, 0.4f, 0.4f, 0.5f);
	box(1.2f, -0.59f, -6, 0.4f);
}

static void lights(int which)
{
	for (int k = 0; k < 2; k++)
		(which >> k & 1 ? glEnable : glDisable)(GL_LIGHT0 + (GLenum)k);
}

static void depth_alone(void (*draw)(void))
{
	glDisable(GL_LIGHTING);
	glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
	draw();
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	glEnable(GL_LIGHTING);
	glDepthMask(GL_FALSE);
	glDepthFunc(GL_EQUAL);
}

static void boxes(void)
{
	box(-0.5f, -0.49f, -5, 0.5f);
	box(1.2f, -0.59f, -6, 0.4f);
}

static void draw_passes(void)
{
	const GLfloat none[4] = { 0, 0, 0, 1 }, cold[4] = { 0.1f, 0.4f, 0.5f, 1 }, warm[4] = { 0.5f, 0.1f, 0.1f, 1 };
	GLuint list;

	glEnable(GL_COLOR_MATERIAL);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, none);
	for (int k = 0; k < 2; k++) {
		glLightfv(GL_LIGHT0 + (GLenum)k, GL_DIFFUSE, k ? warm : cold);
		glLightfv(GL_LIGHT0 + (GLenum)k, GL_SPECULAR, none);
	}
	list = glGenLists(1);
	glNewList(list, GL_COMPILE);
	world();
	glEndList();
	for (int i = 0; i < 4; i++) {
		begin_frame();
		lamp(GL_LIGHT0, -3, 3, -4, 1);
		lamp(GL_LIGHT1, 3, 4, -3, 1);
		if (i == 0) {
			lights(3);
			world();
		} else if (i == 3) {
			lights(3);
			glColor4f(0.8f, 0.7f, 0.6f, 0.5f);
			tiles(0, 0, 0, 1);
			depth_alone(boxes);
			glEnable(GL_BLEND);
			glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
			boxes();
		} else {
			depth_alone(world);
			glDepthFunc(i == 1 ? GL_EQUAL : GL_LEQUAL);
			glBlendFunc(GL_ONE, GL_ONE);
			for (int k = 0; k < 2; k++) {
				(i == 1 || k ? glEnable : glDisable)(GL_BLEND);
				lights(1 << k);
				if (i == 1)
					world();
				else
					glCallList(list);
			}
		}
		glDisable(GL_BLEND);
		glDepthFunc(GL_LESS);
		glDepthMask(GL_TRUE);
		end_frame();
	}
}

/* --- sky, globe -------------------------------------------------------------------------------- */

static void draw_sky(void)
{
	for (int i = 0; i < 3; i++) {
		begin_frame();
		lamp(GL_LIGHT0, 0, 6, -5, 1);
		if (i == 1) {
			glPushMatrix();
			glScalef(1 / 16.0f, 1 / 16.0f, 1 / 16.0f);
			box(-16, 22, -60, 9);
			box(20, 24, -70, 12);
			box(0, 40, -80, 20);
			glPopMatrix();
			glClear(GL_DEPTH_BUFFER_BIT);
		}
		tiles(0, 0, 0, 1);
		box(0.8f, -0.5f, -5, 0.4f);
		if (i == 2) {
			glClear(GL_DEPTH_BUFFER_BIT);
			box(0, 3.5f, -5, 1.5f);
		}
		end_frame();
	}
}

static void corner(int around, int down, float r, int normals)
{
	const float u = (float)around * TURN / 16, v = (float)down * TURN / 24;
	const float x = sinf(v) * cosf(u), y = cosf(v), z = sinf(v) * sinf(u);

	if (normals)
		glNormal3f(x, y, z);
	glVertex3f(r * x, r * y, r * z);
}

/* Strips from pole to pole, each a draw or all in one draw. */
static void globe(float r, int is_one, int normals)
{
	if (is_one)
		glBegin(GL_QUADS);
	for (int down = 0; down < 12; down++) {
		if (!is_one)
			glBegin(GL_QUADS);
		for (int around = 0; around < 16; around++) {
			corner(around + 1, down, r, normals);
			corner(around + 1, down + 1, r, normals);
			corner(around, down + 1, r, normals);
			corner(around, down, r, normals);
		}
		if (!is_one)
			glEnd();
	}
	if (is_one)
		glEnd();
}

static void draw_globe(void)
{
	for (int i = 0; i < 6; i++) {
		begin_frame();
		lamp(GL_LIGHT0, 0, 0.4f, -5, 1);
		tiles(0, 0, 0, 1);
		glPushMatrix();
		glTranslatef(i == 5 ? 0.3f : 0, i == 5 ? 0.2f : 0.4f, -5);
		if (i == 1 || i == 4)
			glDisable(GL_LIGHTING);
		if (i == 3)
			box(0, 0, 0, 0.1f);
		else if (i)
			globe(0.1f, i == 2, i != 4);
		glEnable(GL_LIGHTING);
		glPopMatrix();
		end_frame();
	}
}

int main(int argc, char **argv)
{
	static const struct {
		const char *name;
		void (*draw)(void);
	} kinds[] = { { "far", draw_far }, { "plane", draw_plane }, { "passes", draw_passes }, { "sky", draw_sky },
		      { "globe", draw_globe } };

	window_size[0] = window_size[1] = 100;
	open_window();
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_NORMALIZE);
	for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++)
		if (argc == 2 && strcmp(argv[1], kinds[i].name) == 0) {
			kinds[i].draw();
			return 0;
		}
	fprintf(stderr, "usage: blocking far|plane|passes|sky|globe\n");
	return 2;
}
