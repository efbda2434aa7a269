/*
 * Trees as games drew them, and a hut. Each tree is two crossed cards, cut out by the alpha test and lit; all trees are
 * one draw. Each card blocks the other's light.
 *
 *   cc -o tree_cards corpus/tree_cards.c -lglut -lGLU -lGL -lm
 */
#include <math.h>

#include "program.h"

static GLuint foliage;

/** A crown and a trunk, with holes between the leaves. */
static void make_foliage(void)
{
	enum { SIZE = 128 };
	static GLubyte texels[SIZE][SIZE][4];

	for (int y = 0; y < SIZE; y++)
		for (int x = 0; x < SIZE; x++) {
			float u = ((float)x + 0.5f) / SIZE - 0.5f, v = ((float)y + 0.5f) / SIZE;
			float crown = 0.45f * (1 - v) / 0.8f, leaf = sinf(55 * u + 9 * v) * sinf(49 * v + 5 * u);
			int is_trunk = v < 0.25f && fabsf(u) < 0.05f;
			int is_leaf = v >= 0.2f && fabsf(u) < crown && leaf > -0.75f;

			texels[y][x][0] = is_leaf ? (GLubyte)(90 + 30 * leaf) : 120;
			texels[y][x][1] = is_leaf ? (GLubyte)(170 + 40 * leaf) : 85;
			texels[y][x][2] = is_leaf ? 70 : 50;
			texels[y][x][3] = is_trunk || is_leaf ? 255 : 0;
		}
	glGenTextures(1, &foliage);
	glBindTexture(GL_TEXTURE_2D, foliage);
	gluBuild2DMipmaps(GL_TEXTURE_2D, GL_RGBA, SIZE, SIZE, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
}

static void init(void)
{
	make_foliage();
	glClearColor(0.6f, 0.75f, 0.9f, 1);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_NORMALIZE);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
	glAlphaFunc(GL_GEQUAL, 0.5f);
	program_perspective(45, 0.5, 80);
}

static void card(float x, float z, float across, float along)
{
	glNormal3f(-along, 0.6f, across);
	glTexCoord2f(0, 0);
	glVertex3f(x - across, 0, z - along);
	glTexCoord2f(1, 0);
	glVertex3f(x + across, 0, z + along);
	glTexCoord2f(1, 1);
	glVertex3f(x + across, 4, z + along);
	glTexCoord2f(0, 1);
	glVertex3f(x - across, 4, z - along);
}

static void draw_trees(void)
{
	program_color(1, 1, 1);
	glEnable(GL_TEXTURE_2D);
	glEnable(GL_ALPHA_TEST);
	glBegin(GL_QUADS);
	for (int i = 0; i < 9; i++) {
		float x = -6 + 6 * (float)(i % 3) + 0.7f * sinf(3 * (float)i), z = 2 - 5 * (float)(i / 3);
		float a = 0.5f + (float)i;

		card(x, z, 1.5f * cosf(a), 1.5f * sinf(a));
		card(x, z, -1.5f * sinf(a), 1.5f * cosf(a));
	}
	glEnd();
	glDisable(GL_ALPHA_TEST);
	glDisable(GL_TEXTURE_2D);
}

static void draw_ground(void)
{
	program_color(0.75f, 0.8f, 0.65f);
	glBegin(GL_QUADS);
	glNormal3f(0, 1, 0);
	glVertex3f(-25, 0, 15);
	glVertex3f(25, 0, 15);
	glVertex3f(25, 0, -30);
	glVertex3f(-25, 0, -30);
	glEnd();
}

static void draw(void)
{
	float camera = program_moved(program.animate_camera, 0.05f), light = program_moved(program.animate_light, 0.05f);

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	gluLookAt(14 * sinf(camera), 5, 14 * cosf(camera), 0, 1.5, -1, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ cosf(light), 0.8f, 0.5f + sinf(light), 0 });
	draw_ground();
	draw_trees();
	program_color(0.7f, 0.45f, 0.35f);
	glTranslatef(3, 0.75f, 4);
	glutSolidCube(1.5);
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "tree cards", init, draw);
	return 0;
}
