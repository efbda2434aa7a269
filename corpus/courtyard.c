/*
 * A courtyard without OpenGL's lighting, as games drew it: a sky around the viewer, textured ground, walls, pillars and
 * crates, sparks that face the viewer, an object in the viewer's hand, and a bar for the viewer's health.
 *
 * courtyard lit: OpenGL lights everything from a lamp over the crates, including the sky.
 *
 *   cc -o courtyard corpus/courtyard.c -lglut -lGLU -lGL -lm
 */
#include <math.h>
#include <string.h>

#include "program.h"

enum { SIZE = 64, N_TEXTURES = 4 };
static GLuint textures[N_TEXTURES]; /* stone, wood, sky, spark */
static int is_lit;

static void make_texel(int texture, int x, int y, GLubyte *out)
{
	const int grain = (x * 7 + y * 13 + x * y) % 17, joint = x % 32 < 2 || y % 16 < 2;
	const double r = hypot(x - SIZE / 2 + 0.5, y - SIZE / 2 + 0.5) / (SIZE / 2);
	const int colors[N_TEXTURES][3] = { { 150 - 3 * grain, 145 - 3 * grain, 130 - 2 * grain },
		                            { 150 - 4 * grain, 100 - 3 * grain, 60 },
		                            { 90 + y, 140 + y, 220 },
		                            { 255, 200, 90 } };

	for (int c = 0; c < 3; c++)
		out[c] = (GLubyte)(colors[texture][c] - (texture == 0 && joint ? 40 : 0));
	out[3] = texture == 3 ? (GLubyte)(r < 1 ? 255 * (1 - r) : 0) : 255;
}

static void init(void)
{
	static GLubyte texels[SIZE][SIZE][4];

	glGenTextures(N_TEXTURES, textures);
	for (int i = 0; i < N_TEXTURES; i++) {
		for (int y = 0; y < SIZE; y++)
			for (int x = 0; x < SIZE; x++)
				make_texel(i, x, y, texels[y][x]);
		glBindTexture(GL_TEXTURE_2D, textures[i]);
		gluBuild2DMipmaps(GL_TEXTURE_2D, GL_RGBA, SIZE, SIZE, GL_RGBA, GL_UNSIGNED_BYTE, texels);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
	}
	glBlendFunc(GL_SRC_ALPHA, GL_ONE);
}

/** A side of a box, at distance 1 along an axis, with its texture repeated `repeat` times; negative: seen from
 * inside. */
static void draw_side(int axis, float sign, float repeat)
{
	static const float corners[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
	const float outwards = repeat < 0 ? -sign : sign;

	glNormal3f(axis == 0 ? outwards : 0, axis == 1 ? outwards : 0, axis == 2 ? outwards : 0);
	for (int i = 0; i < 4; i++) {
		float at[3];

		at[axis] = sign;
		at[(axis + 1) % 3] = corners[i][0];
		at[(axis + 2) % 3] = corners[i][1];
		glTexCoord2f(fabsf(repeat) * (axis == 1 ? at[0] : at[(axis + 2) % 3 == 1 ? (axis + 1) % 3 : (axis + 2) % 3]) * 0.5f,
		             fabsf(repeat) * (axis == 1 ? at[2] : at[1]) * 0.5f);
		glVertex3fv(at);
	}
}

static void draw_box(float x, float y, float z, float width, float height, float depth, float repeat)
{
	glPushMatrix();
	glTranslatef(x, y, z);
	glScalef(0.5f * width, 0.5f * height, 0.5f * depth);
	glBegin(GL_QUADS);
	for (int axis = 0; axis < 3; axis++) {
		draw_side(axis, 1, repeat);
		draw_side(axis, -1, repeat);
	}
	glEnd();
	glPopMatrix();
}

static void draw_world(void)
{
	glBindTexture(GL_TEXTURE_2D, textures[0]);
	draw_box(0, -0.5f, 0, 24, 1, 24, 8);
	draw_box(0, 1.5f, -8, 16, 3, 0.5f, 6);
	draw_box(-8, 1.5f, 0, 0.5f, 3, 16, 6);
	draw_box(8, 1.5f, 0, 0.5f, 3, 16, 6);
	for (int i = 0; i < 4; i++)
		draw_box(-4.5f + 3 * (float)i, 1, -5, 0.6f, 2, 0.6f, 1);
	draw_box(0, 2.15f, -5, 10, 0.3f, 1, 4);
	glBindTexture(GL_TEXTURE_2D, textures[1]);
	draw_box(-3.2f, 0.5f, -2, 1, 1, 1, 1);
	draw_box(-2.1f, 0.4f, -2.3f, 0.8f, 0.8f, 0.8f, 1);
	draw_box(-2.8f, 1.35f, -2.1f, 0.7f, 0.7f, 0.7f, 1);
	draw_box(3, 0.6f, -3, 1.2f, 1.2f, 1.2f, 1);
}

/** Sparks rise beside the crates; each always faces the viewer. They write depth, as careless programs do. */
static void draw_sparks(void)
{
	float m[16];

	glGetFloatv(GL_MODELVIEW_MATRIX, m);
	glEnable(GL_BLEND);
	glBindTexture(GL_TEXTURE_2D, textures[3]);
	glBegin(GL_QUADS);
	for (int i = 0; i < 8; i++) {
		const float y = 0.3f + fmodf(0.31f * (float)i + 0.05f * (float)program_frame, 2.2f),
			    x = 1 + 0.4f * sinf(5 * y + (float)i), z = -3 + 0.3f * cosf(4 * y);

		for (int k = 0; k < 4; k++) {
			const float u = k == 1 || k == 2 ? 0.2f : -0.2f, v = k > 1 ? 0.2f : -0.2f;

			glTexCoord2f(k == 1 || k == 2, k > 1);
			glVertex3f(x + u * m[0] + v * m[1], y + u * m[4] + v * m[5], z + u * m[8] + v * m[9]);
		}
	}
	glEnd();
	glDisable(GL_BLEND);
}

/** Draw the object in the hand, whatever the view's direction; then a bar in window space. */
static void draw_viewer(void)
{
	glLoadIdentity();
	glBindTexture(GL_TEXTURE_2D, textures[1]);
	draw_box(0.35f, -0.3f, -0.9f, 0.12f, 0.12f, 0.7f, 2);
	glDisable(GL_TEXTURE_2D);
	glMatrixMode(GL_PROJECTION);
	glPushMatrix();
	glLoadIdentity();
	gluOrtho2D(0, 100, 0, 75);
	glClear(GL_DEPTH_BUFFER_BIT);
	glColor3f(0.8f, 0.1f, 0.1f);
	glRectf(3, 3, 33, 6);
	glColor3f(1, 1, 1);
	glPopMatrix();
	glMatrixMode(GL_MODELVIEW);
	glEnable(GL_TEXTURE_2D);
}

/** A lamp in front of the pillars. */
static void light(void)
{
	const float place[4] = { 0, 1.2f, -3, 1 }, dim[4] = { 0.5f, 0.5f, 0.5f, 1 };

	if (!is_lit)
		return;
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_NORMALIZE);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, dim);
	glLightfv(GL_LIGHT0, GL_POSITION, place);
}

static void draw(void)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_TEXTURE_2D);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	gluPerspective(60, (double)PROGRAM_WIDTH / PROGRAM_HEIGHT, 0.1, 100);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glRotatef(12, 1, 0, 0);
	glRotatef(program_moved(program.animate_camera, 5), 0, 1, 0);
	glBindTexture(GL_TEXTURE_2D, textures[2]);
	glPushMatrix();
	glTranslatef(program_moved(program.animate_camera, 0.3f), -2, -3.5f);
	light();
	glPopMatrix();
	draw_box(0, 0, 0, 60, 60, 60, -1.5f);
	glTranslatef(program_moved(program.animate_camera, 0.3f), -2, -3.5f);
	draw_world();
	glDisable(GL_LIGHTING);
	draw_sparks();
	draw_viewer();
}

int main(int argc, char **argv)
{
	is_lit = argc > 1 && strcmp(argv[1], "lit") == 0;
	argv[is_lit] = argv[0];
	program_run(argc - is_lit, argv + is_lit, "courtyard", init, draw);
	return 0;
}
