/*
 * A cube over a floor, and effects that replaced traced light: a shadow flattened onto the floor, a shadow volume in
 * the stencil buffer, a mirror drawn as the world behind it; or none of these, or a mirror by rtMaterialEXT. The light
 * is at (2, 4, 1) of the world, or infinitely far in that direction; the mirror is the plane z = -3. From frame 1 on
 * the viewer moves around. `grid` and `gravel` also flatten the shadow, but their floor is a single picture without
 * OpenGL's light: dark with bright lines, or grainy.
 *
 *   cc -o tricks corpus/tricks.c -lglut -lGLU -lGL -lm
 *   tricks planar|directional|zpass|zfail|mirror|none|traced-mirror|grid|gravel [--frames N]
 */
#include <math.h>

#include "program.h"

enum { PLANAR, DIRECTIONAL, ZPASS, ZFAIL, MIRROR, NONE, TRACED_MIRROR, GRID, GRAVEL, N_KINDS };

static const char *const kinds[] = { "planar", "directional",   "zpass", "zfail", "mirror",
	                             "none",   "traced-mirror", "grid",  "gravel" };
static int kind;
static float light[4] = { 2, 4, 1, 1 };
static const float corners[8][3] = { { -1, -1, -1 }, { 1, -1, -1 }, { -1, 1, -1 }, { 1, 1, -1 },
	                             { -1, -1, 1 },  { 1, -1, 1 },  { -1, 1, 1 },  { 1, 1, 1 } };
/* Corners of each face, counter-clockwise seen from outside, and its normal. */
static const int faces[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
	                         { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
static const float normals[6][3] = { { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, -1 }, { 0, 0, 1 } };

static void cube(void)
{
	glBegin(GL_QUADS);
	for (int f = 0; f < 6; f++) {
		glNormal3fv(normals[f]);
		for (int k = 0; k < 4; k++)
			glVertex3fv(corners[faces[f][k]]);
	}
	glEnd();
}

static void place_cube(void)
{
	glTranslatef(0.5f, 1.5f, 0);
	glRotatef(20, 0, 1, 0);
	glScalef(0.6f, 0.6f, 0.6f);
}

/* The floor in small squares, as OpenGL lights vertices. */
static void draw_floor(void)
{
	glBegin(GL_QUADS);
	glNormal3f(0, 1, 0);
	for (int x = -12; x < 12; x++)
		for (int z = -6; z < 12; z++) {
			glVertex3f(0.5f * (float)x, 0, 0.5f * (float)z);
			glVertex3f(0.5f * (float)x, 0, 0.5f * (float)z + 0.5f);
			glVertex3f(0.5f * (float)x + 0.5f, 0, 0.5f * (float)z + 0.5f);
			glVertex3f(0.5f * (float)x + 0.5f, 0, 0.5f * (float)z);
		}
	glEnd();
}

static void make_picture(void)
{
	enum { SIZE = 64 };
	static GLubyte texels[SIZE][SIZE][3];

	for (int y = 0; y < SIZE; y++)
		for (int x = 0; x < SIZE; x++)
			for (int c = 0; c < 3; c++)
				texels[y][x][c] = kind == GRAVEL ? (GLubyte)((x * 37 + y * 59 + x * y * 11) % 48) : x < 3 || y < 3 ? 180 : 16;
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, SIZE, SIZE, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
}

/* The floor as one unlit square. It sets no normal: the cube's last one is current. */
static void draw_picture(void)
{
	glDisable(GL_LIGHTING);
	glEnable(GL_TEXTURE_2D);
	glColor3f(1, 1, 1);
	glBegin(GL_QUADS);
	for (int k = 0; k < 4; k++) {
		const float x = k == 1 || k == 2 ? 6.0f : -6.0f, z = k < 2 ? 6.0f : -3.0f;

		glTexCoord2f(x / 2, z / 2);
		glVertex3f(x, 0, z);
	}
	glEnd();
	glDisable(GL_TEXTURE_2D);
	glEnable(GL_LIGHTING);
}

static void color(float r, float g, float b, float a)
{
	glColor4f(r, g, b, a);
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, (const float[]){ r, g, b, a });
}

static void draw_world(void)
{
	glLightfv(GL_LIGHT0, GL_POSITION, light);
	glEnable(GL_LIGHTING);
	color(0.8f, 0.8f, 0.7f, 1);
	if (kind == GRID || kind == GRAVEL)
		draw_picture();
	else
		draw_floor();
	color(0.8f, 0.3f, 0.2f, 1);
	glPushMatrix();
	place_cube();
	cube();
	glPopMatrix();
	glDisable(GL_LIGHTING);
}

/* (P . L) I - L P^T for the floor, P = (0, 1, 0, 0). */
static void flatten(void)
{
	const float p[4] = { 0, 1, 0, 0 };
	float m[16];

	for (int c = 0; c < 4; c++)
		for (int r = 0; r < 4; r++)
			m[4 * c + r] = (r == c ? light[1] : 0) - light[r] * p[c];
	glMultMatrixf(m);
}

static void flat_shadow(void)
{
	glEnable(GL_POLYGON_OFFSET_FILL);
	glPolygonOffset(-1, -1);
	glEnable(GL_STENCIL_TEST); /* darken each pixel once */
	glStencilFunc(GL_EQUAL, 0, ~0u);
	glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glColor4f(0, 0, 0, 0.5f);
	glPushMatrix();
	flatten();
	place_cube();
	cube();
	glPopMatrix();
	glDisable(GL_BLEND);
	glDisable(GL_STENCIL_TEST);
	glDisable(GL_POLYGON_OFFSET_FILL);
}

/* The light's position in the cube's space. */
static void light_of_cube(float out[3])
{
	const float c = cosf(20 * 3.14159265f / 180), s = sinf(20 * 3.14159265f / 180);
	const float x = light[0] - 0.5f, y = light[1] - 1.5f, z = light[2];

	out[0] = (c * x - s * z) / 0.6f;
	out[1] = y / 0.6f;
	out[2] = (s * x + c * z) / 0.6f;
}

/* Each lit face, with its sides extended to infinity: sides between two lit faces cancel. */
static void volume(void)
{
	float l[3];

	light_of_cube(l);
	glBegin(GL_QUADS);
	for (int f = 0; f < 6; f++) {
		const float *p[4], *n = normals[f];

		if (n[0] * l[0] + n[1] * l[1] + n[2] * l[2] <= 1)
			continue;
		for (int k = 0; k < 4; k++)
			p[k] = corners[faces[f][k]];
		for (int k = 0; k < 4; k++)
			glVertex3fv(p[k]);
		for (int k = 3; k >= 0; k--)
			glVertex4f(p[k][0] - l[0], p[k][1] - l[1], p[k][2] - l[2], 0);
		for (int k = 0; k < 4; k++) {
			const float *a = p[k], *b = p[(k + 1) % 4];

			glVertex3fv(b);
			glVertex3fv(a);
			glVertex4f(a[0] - l[0], a[1] - l[1], a[2] - l[2], 0);
			glVertex4f(b[0] - l[0], b[1] - l[1], b[2] - l[2], 0);
		}
	}
	glEnd();
}

static void darken(void)
{
	glMatrixMode(GL_PROJECTION);
	glPushMatrix();
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glPushMatrix();
	glLoadIdentity();
	glStencilFunc(GL_NOTEQUAL, 0, ~0u);
	glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glColor4f(0, 0, 0, 0.5f);
	glRectf(-1, -1, 1, 1);
	glDisable(GL_BLEND);
	glEnable(GL_DEPTH_TEST);
	glPopMatrix();
	glMatrixMode(GL_PROJECTION);
	glPopMatrix();
	glMatrixMode(GL_MODELVIEW);
}

static void volume_shadow(void)
{
	glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
	glDepthMask(GL_FALSE);
	glEnable(GL_CULL_FACE);
	glEnable(GL_STENCIL_TEST);
	glStencilFunc(GL_ALWAYS, 0, ~0u);
	for (int side = 0; side < 2; side++) {
		const GLenum counts = side ? GL_DECR_WRAP : GL_INCR_WRAP;

		/* z-pass: front faces increment, back faces decrement; z-fail: the reverse */
		glCullFace((kind == ZPASS) == (side == 0) ? GL_BACK : GL_FRONT);
		if (kind == ZPASS)
			glStencilOp(GL_KEEP, GL_KEEP, counts);
		else
			glStencilOp(GL_KEEP, counts, GL_KEEP);
		glPushMatrix();
		place_cube();
		volume();
		glPopMatrix();
	}
	glDisable(GL_CULL_FACE);
	glDepthMask(GL_TRUE);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	darken();
	glDisable(GL_STENCIL_TEST);
}

static void mirror_surface(void)
{
	glBegin(GL_QUADS);
	glNormal3f(0, 0, 1);
	glVertex3f(-3, 0, -3);
	glVertex3f(3, 0, -3);
	glVertex3f(3, 3, -3);
	glVertex3f(-3, 3, -3);
	glEnd();
}

static void mirrored_world(void)
{
	glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
	glDepthMask(GL_FALSE);
	glEnable(GL_STENCIL_TEST);
	glStencilFunc(GL_ALWAYS, 1, ~0u);
	glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
	mirror_surface();
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	glDepthMask(GL_TRUE);
	glStencilFunc(GL_EQUAL, 1, ~0u);
	glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
	glPushMatrix();
	glTranslatef(0, 0, -6);
	glScalef(1, 1, -1);
	draw_world();
	glPopMatrix();
	glDisable(GL_STENCIL_TEST);
	glClear(GL_DEPTH_BUFFER_BIT);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glColor4f(0.6f, 0.7f, 0.8f, 0.2f);
	mirror_surface();
	glDisable(GL_BLEND);
}

static void draw(void)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	glLoadIdentity();
	glTranslatef(0, -1.5f, -8);
	glRotatef(5 * (float)program_frame, 0, 1, 0);
	if (kind == MIRROR)
		mirrored_world();
	draw_world();
	if (kind == PLANAR || kind == DIRECTIONAL || kind == GRID || kind == GRAVEL)
		flat_shadow();
	if (kind == ZPASS || kind == ZFAIL)
		volume_shadow();
	if (kind == TRACED_MIRROR) {
		rtMaterialEXT(RT_MIRROR_EXT, 0.8f, 1);
		glColor4f(0.6f, 0.7f, 0.8f, 1);
		mirror_surface();
		rtMaterialEXT(RT_MATTE_EXT, 0, 1);
	}
}

static void init(void)
{
	glClearColor(0.4f, 0.5f, 0.6f, 1);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_NORMALIZE);
	glEnable(GL_LIGHT0);
	program_perspective(45, 0.5, 60);
	if (kind == GRID || kind == GRAVEL)
		make_picture();
}

int main(int argc, char **argv)
{
	for (kind = 0; argc > 1 && kind < N_KINDS && strcmp(argv[1], kinds[kind]) != 0;)
		kind++;
	if (argc < 2 || kind == N_KINDS) {
		fprintf(stderr,
		        "usage: %s planar|directional|zpass|zfail|mirror|none|traced-mirror|grid|gravel [--frames N]\n",
		        argv[0]);
		return 2;
	}
	argv[1] = argv[0];
	light[3] = kind != DIRECTIONAL;
	program.stencil = 1;
	program_run(argc - 1, argv + 1, "tricks", init, draw);
	return 0;
}
