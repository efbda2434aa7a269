/*
 * A street at dusk, as games drew it: a sky around the viewer, drawn first and without depth, a lit ball that rolls
 * over a blob shadow, a mark on the ground, a lamp whose bulb is bright texels. The viewer does not move.
 *
 *   cc -o street corpus/street.c -lglut -lGLU -lGL -lm
 *
 * --by unlit draws it without OpenGL's lights, --by plain with neither blob nor mark, --by thrown with the blob as a
 * texture unit of the ground, its coordinates generated from positions.
 */
#include <math.h>

#include "program.h"

enum { SIZE = 64, ROAD = 0, SKY, BLOB, MARK, LAMP, N_TEXTURES };
static GLuint textures[N_TEXTURES];

static void make_texel(int texture, int x, int y, GLubyte *out)
{
	const int grain = (x * 7 + y * 13 + x * y) % 17;
	const double r = hypot(x - SIZE / 2 + 0.5, y - SIZE / 2 + 0.5) / (SIZE / 2 - 1);
	const double sun = hypot(x - 39.5, y - 25.5) / 4;
	const int colors[N_TEXTURES][4] = {
		{ 150 - 3 * grain, 145 - 3 * grain, 140 - 2 * grain, 255 }, { 235 - 2 * y, 150 - y / 2, 110 + y, 255 },
		{ 0, 0, 0, r < 1 ? (int)(150 * (1 - r * r)) : 0 }, { 240, 240, 230, r < 0.9 && r > 0.6 ? 255 : 0 },
		{ 255, 230, 140, 255 },
	};

	for (int c = 0; c < 4; c++)
		out[c] = (GLubyte)colors[texture][c];
	if (texture == SKY && sun < 1)
		memset(out, 255, 3);
	if (texture == LAMP && y < SIZE / 4)
		out[0] = out[1] = out[2] = 60; /* the bulb's socket */
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
		if (i == ROAD)
			continue;
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	}
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	program_color(0.9f, 0.9f, 0.9f);
	glEnable(GL_LIGHT0);
	glEnable(GL_NORMALIZE);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (const float[]){ 0.35f, 0.35f, 0.4f, 1 });
	glLightfv(GL_LIGHT0, GL_DIFFUSE, (const float[]){ 0.6f, 0.5f, 0.4f, 1 });
}

/** Four sides and the top of a box around the viewer; each shows the same dusk, the one ahead with the sun. */
static void draw_sky(void)
{
	glBindTexture(GL_TEXTURE_2D, textures[SKY]);
	glDepthMask(GL_FALSE);
	for (int side = 0; side < 4; side++) {
		const float u = side ? 0 : 1; /* sides without the sun use only the texture's left edge */

		glPushMatrix();
		glRotatef(90.0f * (float)side, 0, 1, 0);
		glBegin(GL_QUADS);
		glTexCoord2f(0, 0); glVertex3f(-5, -1, -5);
		glTexCoord2f(u, 0); glVertex3f(5, -1, -5);
		glTexCoord2f(u, 1); glVertex3f(5, 5, -5);
		glTexCoord2f(0, 1); glVertex3f(-5, 5, -5);
		glEnd();
		glPopMatrix();
	}
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		glTexCoord2f(0, 1);
		glVertex3f(i == 1 || i == 2 ? 5 : -5, 5, i > 1 ? 5 : -5);
	}
	glEnd();
	glDepthMask(GL_TRUE);
}

/** A square of the ground, or one lying on it. */
static void draw_ground(int texture, float x, float z, float half, float repeat)
{
	glBindTexture(GL_TEXTURE_2D, textures[texture]);
	glNormal3f(0, 1, 0);
	glBegin(GL_QUADS);
	glTexCoord2f(0, 0); glVertex3f(x - half, 0, z + half);
	glTexCoord2f(repeat, 0); glVertex3f(x + half, 0, z + half);
	glTexCoord2f(repeat, repeat); glVertex3f(x + half, 0, z - half);
	glTexCoord2f(0, repeat); glVertex3f(x - half, 0, z - half);
	glEnd();
}

/** The ground with the ball's blob in its first texture unit, its own texture in the next. */
static void draw_ground_under(float ball)
{
	const GLenum coords[2] = { GL_S, GL_T };

	glActiveTexture(GL_TEXTURE1);
	glEnable(GL_TEXTURE_2D);
	glBindTexture(GL_TEXTURE_2D, textures[ROAD]);
	glActiveTexture(GL_TEXTURE0);
	glBindTexture(GL_TEXTURE_2D, textures[BLOB]);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
	glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_MODULATE);
	glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB, GL_PREVIOUS);
	glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE1_RGB, GL_TEXTURE);
	glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND1_RGB, GL_ONE_MINUS_SRC_ALPHA);
	for (int i = 0; i < 2; i++) {
		const float plane[4] = { i ? 0 : 1 / 1.6f, 0, i ? 1 / 1.6f : 0, i ? 0.5f + 4 / 1.6f : 0.5f - ball / 1.6f };

		glTexGeni(coords[i], GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
		glTexGenfv(coords[i], GL_OBJECT_PLANE, plane);
		glEnable(i ? GL_TEXTURE_GEN_T : GL_TEXTURE_GEN_S);
	}
	glNormal3f(0, 1, 0);
	glBegin(GL_QUADS);
	glMultiTexCoord2f(GL_TEXTURE1, 0, 0); glVertex3f(-8, 0, 0);
	glMultiTexCoord2f(GL_TEXTURE1, 6, 0); glVertex3f(8, 0, 0);
	glMultiTexCoord2f(GL_TEXTURE1, 6, 6); glVertex3f(8, 0, -16);
	glMultiTexCoord2f(GL_TEXTURE1, 0, 6); glVertex3f(-8, 0, -16);
	glEnd();
	glDisable(GL_TEXTURE_GEN_S);
	glDisable(GL_TEXTURE_GEN_T);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
	glActiveTexture(GL_TEXTURE1);
	glDisable(GL_TEXTURE_2D);
	glActiveTexture(GL_TEXTURE0);
}

/** Draw the decals on the ground: the mark, then the ball's blob. */
static void draw_laid(float ball, int is_lit)
{
	glEnable(GL_BLEND);
	glEnable(GL_POLYGON_OFFSET_FILL);
	glPolygonOffset(-1, -2);
	glDepthMask(GL_FALSE);
	draw_ground(MARK, -1.6f, -4.5f, 0.8f, 1);
	glDisable(GL_LIGHTING);
	draw_ground(BLOB, ball, -4, 0.8f, 1);
	if (is_lit)
		glEnable(GL_LIGHTING);
	glDepthMask(GL_TRUE);
	glDisable(GL_POLYGON_OFFSET_FILL);
	glDisable(GL_BLEND);
}

/** A ball of quads in a single draw. */
static void draw_ball(float radius)
{
	enum { AROUND = 24, UP = 12 };

	glBegin(GL_QUADS);
	for (int j = 0; j < UP; j++)
		for (int i = 0; i < AROUND; i++)
			for (int k = 0; k < 4; k++) {
				const float a = 6.2831853f * (float)(i + (k == 1 || k == 2)) / AROUND,
					    b = 3.1415927f * ((float)(j + k / 2) / UP - 0.5f);
				const float n[3] = { cosf(b) * sinf(a), sinf(b), cosf(b) * cosf(a) };

				glNormal3fv(n);
				glTexCoord2f(a, b);
				glVertex3f(radius * n[0], radius * n[1], radius * n[2]);
			}
	glEnd();
}

static void draw_things(float ball)
{
	GLUquadric *quadric = gluNewQuadric();

	glBindTexture(GL_TEXTURE_2D, textures[ROAD]);
	glPushMatrix();
	glTranslatef(ball, 0.6f, -4);
	draw_ball(0.6f);
	glPopMatrix();
	glPushMatrix(); /* the lamp post */
	glTranslatef(2.6f, 2.4f, -5);
	glRotatef(90, 1, 0, 0);
	gluCylinder(quadric, 0.07, 0.07, 2.4, 8, 1);
	glPopMatrix();
	gluDeleteQuadric(quadric);
}

/** An unlit bulb: only bright texels. */
static void draw_lamp(void)
{
	glDisable(GL_LIGHTING);
	glBindTexture(GL_TEXTURE_2D, textures[LAMP]);
	glPushMatrix();
	glTranslatef(2.6f, 2.4f, -5);
	glBegin(GL_QUADS);
	for (int side = 0; side < 4; side++) {
		const float x[5] = { -0.2f, 0.2f, 0.2f, -0.2f, -0.2f }, z[5] = { 0.2f, 0.2f, -0.2f, -0.2f, 0.2f };

		glTexCoord2f(0, 0); glVertex3f(x[side], 0, z[side]);
		glTexCoord2f(1, 0); glVertex3f(x[side + 1], 0, z[side + 1]);
		glTexCoord2f(1, 1); glVertex3f(x[side + 1], 0.5f, z[side + 1]);
		glTexCoord2f(0, 1); glVertex3f(x[side], 0.5f, z[side]);
	}
	glEnd();
	glPopMatrix();
}

static void draw(void)
{
	const int is_lit = !program.by || strcmp(program.by, "unlit") != 0;
	const float ball = -0.4f + 0.1f * (float)program_frame;

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_TEXTURE_2D);
	program_perspective(60, 0.1, 100);
	glLoadIdentity();
	glRotatef(10, 1, 0, 0);
	glDisable(GL_LIGHTING);
	draw_sky();
	glTranslatef(0, -2, 0);
	if (is_lit) {
		glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ -0.5f, 1, 0.3f, 0 });
		glEnable(GL_LIGHTING);
	}
	if (program.by && strcmp(program.by, "thrown") == 0)
		draw_ground_under(ball);
	else
		draw_ground(ROAD, 0, -8, 8, 6);
	if (!program.by || (strcmp(program.by, "plain") != 0 && strcmp(program.by, "thrown") != 0))
		draw_laid(ball, is_lit);
	draw_things(ball);
	draw_lamp();
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "street", init, draw);
	return 0;
}
