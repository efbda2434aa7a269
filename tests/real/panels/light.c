/* Lighting (OpenGL 2.1 sec. 2.14): a bowl with normals in all directions, under each term of the equations. */
#include <math.h>

#include "panels.h"

/* A spherical cap that opens towards the viewer (up: 1) or away from them (-1); its rim faces sideways. */
static void cap(float up, float longer)
{
	enum { RINGS = 5, SECTORS = 10 };

	for (int r = 0; r < RINGS; r++) {
		glBegin(GL_QUAD_STRIP);
		for (int s = 0; s <= SECTORS; s++)
			for (int k = 1; k >= 0; k--) {
				const float a = 6.2831853f * (float)s / SECTORS, b = 1.4f * (float)(r + k) / RINGS;
				const float n[3] = { sinf(b) * cosf(a), sinf(b) * sinf(a), cosf(b) };

				glColor4f(0.5f + 0.5f * n[0], 0.5f + 0.5f * n[1], n[2], 0.5f + 0.4f * n[1]);
				glNormal3f(longer * n[0], longer * n[1], longer * n[2] * up);
				glVertex3f(n[0], n[1], n[2] * up);
			}
		glEnd();
	}
}

static void draw_cap(int i)
{
	(void)i;
	cap(1, 1);
}

static void light(unsigned i, float x, float y, float z, float w)
{
	const float position[4] = { x, y, z, w }, ambient[4] = { 0.1f, 0.05f, 0.15f, 1 }, diffuse[4] = { 0.8f, 0.7f, 0.5f, 1 },
	            specular[4] = { 0.4f, 0.6f, 0.9f, 1 };

	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0 + i);
	glLightfv(GL_LIGHT0 + i, GL_POSITION, position);
	glLightfv(GL_LIGHT0 + i, GL_AMBIENT, ambient);
	glLightfv(GL_LIGHT0 + i, GL_DIFFUSE, diffuse);
	glLightfv(GL_LIGHT0 + i, GL_SPECULAR, specular);
}

static void material(float shininess)
{
	const float ambient[4] = { 0.3f, 0.5f, 0.7f, 0.8f }, diffuse[4] = { 0.9f, 0.6f, 0.8f, 0.7f },
	specular[4] = { 0.7f, 0.8f, 0.5f, 1 },
	            emission[4] = { 0.05f, 0, 0.1f, 0 };

	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, ambient);
	glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, diffuse);
	glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, specular);
	glMaterialfv(GL_FRONT_AND_BACK, GL_EMISSION, emission);
	glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, shininess);
}

/* Each attenuation factor, alone and with the others, for near and far lights with any w. */
static void attenuation(int i)
{
	static const float constants[3] = { 1, 0.3f, 2 }, linears[4] = { 0, 0.25f, 1, 3 }, squares[4] = { 0, 0.1f, 0.6f, 2 };
	static const float places[4][4] = {
		{ 0.5f, 0.4f, 1.5f, 1 }, { -2, 1, 3, 1 }, { 1, 3, 2.4f, 2 }, { 0.3f, 0.5f, 0.8f, 0 }
	};
	const int c = choose(&i, 3), l = choose(&i, 4), q = choose(&i, 4), p = choose(&i, 4);

	material(12);
	light(0, places[p][0], places[p][1], places[p][2], places[p][3]);
	glLightf(GL_LIGHT0, GL_CONSTANT_ATTENUATION, constants[c]);
	glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, linears[l]);
	glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, squares[q]);
}

/*
 * Cones of each width and exponent, aimed at the cap and past it; also for directional lights, where they count, too.
 */
static void spot(int i)
{
	static const float cutoffs[6] = { 180, 90, 61, 34, 12, 0 }, exponents[5] = { 0, 1, 4.5f, 40, 128 };
	static const float directions[3][3] = { { 0, 0, -1 }, { -0.8f, 0.3f, -2 }, { 0, 1, -0.2f } };
	const int c = choose(&i, 6), e = choose(&i, 5), d = choose(&i, 3), directional = choose(&i, 2);

	material(20);
	light(0, 0.6f, 0.2f, 2, directional ? 0 : 1);
	glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, cutoffs[c]);
	glLightf(GL_LIGHT0, GL_SPOT_EXPONENT, exponents[e]);
	glLightfv(GL_LIGHT0, GL_SPOT_DIRECTION, directions[d]);
}

/* Each colour of light, material and model alone: three of the light, four of the material, one of the model;
 * colours below 0 and above 1. */
static void term(int i)
{
	static const float black[4] = { 0, 0, 0, 1 }, bright[4] = { 1.4f, 0.6f, 0.3f, 0.5f },
			   negative[4] = { -0.4f, 0.2f, 0.8f, -1 };
	const int what = choose(&i, 8), how = choose(&i, 3), apart = choose(&i, 2), local = choose(&i, 2);
	const float *color = how == 0 ? black : how == 1 ? bright : negative;
	static const GLenum of_light[3] = { GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR },
			    of_material[4] = { GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION };

	material(6);
	light(0, 0.8f, 0.7f, 1.4f, 1);
	light(1, -0.8f, 0.1f, 0.4f, 0);
	if (what < 3)
		glLightfv(GL_LIGHT0, of_light[what], color);
	else if (what < 7)
		glMaterialfv(GL_FRONT, of_material[what - 3], color);
	else
		glLightModelfv(GL_LIGHT_MODEL_AMBIENT, color);
	glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, apart ? GL_SEPARATE_SPECULAR_COLOR : GL_SINGLE_COLOR);
	glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, local);
}

/* Each shininess. */
static void shininess(int i)
{
	static const float sharp[8] = { 0, 0.5f, 1, 2.5f, 10, 33, 90, 128 };
	static const float white[4] = { 1, 1, 1, 1 };
	const int s = choose(&i, 8), local = choose(&i, 2), far = choose(&i, 2), both = choose(&i, 2);

	material(sharp[s]);
	glMaterialfv(GL_FRONT, GL_SPECULAR, white);
	light(0, 0.4f, 0.5f, 0.9f, far ? 0 : 1);
	if (both)
		light(1, -3, 1, 0.2f, 1);
	glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, local);
}

/* Two-sided lighting, and vertex colours as material colours. */
static void side(int i)
{
	static const GLenum modes[5] = { GL_EMISSION, GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_AMBIENT_AND_DIFFUSE };
	static const GLenum faces[3] = { GL_FRONT, GL_BACK, GL_FRONT_AND_BACK };
	const int mode = choose(&i, 5), face = choose(&i, 3), two = choose(&i, 2), clockwise = choose(&i, 2),
		  tracked = choose(&i, 2);
	static const float back[4] = { 0.1f, 0.9f, 0.2f, 1 };

	material(9);
	glMaterialfv(GL_BACK, GL_DIFFUSE, back);
	light(0, 0.8f, 0.7f, 1.4f, 1);
	light(1, -0.5f, 0.1f, -1.4f, 0);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, two);
	glFrontFace(clockwise ? GL_CW : GL_CCW);
	/* Mesa (22.3.6) leaves a back side's green and blue undefined if vertex colours apply to back sides only. */
	glColorMaterial(faces[two && face == 1 ? 2 : face], modes[mode]);
	if (tracked)
		glEnable(GL_COLOR_MATERIAL);
}

static void draw_side(int i)
{
	cap(i / 5 % 2 ? 1 : -1, 1);
}

/* Normals of other lengths under matrices that stretch, rotate and mirror. */
static void normal(int i)
{
	static const float scales[6][3] = { { 1, 1, 1 },       { 0.5f, 0.5f, 0.5f },  { 1.1f, 1.1f, 1.1f },
		                            { 0.9f, 0.4f, 1 }, { -0.8f, 0.8f, 0.8f }, { 0.7f, 0.9f, -0.5f } };
	const int scale = choose(&i, 6), how = choose(&i, 4), turn = choose(&i, 2);

	material(15);
	light(0, 0.8f, 0.7f, 1.4f, 1);
	glShadeModel(GL_SMOOTH);
	if (how & 1)
		glEnable(GL_NORMALIZE);
	if (how & 2)
		glEnable(GL_RESCALE_NORMAL);
	if (turn)
		glRotatef(33, 0.3f, 1, 0.2f);
	glScalef(scales[scale][0], scales[scale][1], scales[scale][2]);
}

static void draw_normal(int i)
{
	cap(1, i / 48 % 2 ? 1 : 0.6f);
}

/* Normals whose squares underflow a float, wholly or partly. */
static void draw_short_normal(int i)
{
	static const float lengths[4] = { 1e-17f, 3e-21f, 1e-30f, 3e-39f };

	cap(1, lengths[i / 48 % 4]);
}

/* All lights at once, each of a different kind. */
static void many(int i)
{
	material(25);
	for (unsigned k = 0; k < 8; k++)
		if ((i + 1) >> k & 1) {
			light(k, 3 * noise(k) - 1.5f, 3 * noise(k + 8) - 1.5f, 2 * noise(k + 16), k % 3 ? 1 : 0);
			glLightf(GL_LIGHT0 + k, GL_LINEAR_ATTENUATION, 0.3f * (float)k);
			if (k % 2)
				glLightf(GL_LIGHT0 + k, GL_SPOT_CUTOFF, 20 + 10 * (float)k);
		}
}

/* The vertex that provides the flat colour of each primitive (sec. 2.14.7), lit and unlit. */
static void flat(int i)
{
	const int lit = choose(&i, 2), back = choose(&i, 2);

	glShadeModel(GL_FLAT);
	material(7);
	if (lit) {
		light(0, 0.8f, 0.7f, 1.4f, 1);
		glEnable(GL_COLOR_MATERIAL);
	}
	glPolygonMode(GL_FRONT_AND_BACK, back ? GL_LINE : GL_FILL);
}

static void draw_flat(int i)
{
	static const GLenum primitives[9] = { GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN,
		                              GL_QUADS,     GL_QUAD_STRIP,     GL_POLYGON,
		                              GL_LINES,     GL_LINE_STRIP,     GL_LINE_LOOP };
	const GLenum primitive = primitives[i / 4 % 9];

	glBegin(primitive);
	for (int k = 0; k < 6; k++) {
		const float a = 1.0471976f * (float)(primitive == GL_TRIANGLE_STRIP || primitive == GL_QUAD_STRIP ?
		                                             (k % 2 ? 5 - k / 2 : k / 2) :
		                                             k) +
		                0.2f;

		glColor3f(noise((unsigned)k), noise((unsigned)k + 20), noise((unsigned)k + 40));
		glNormal3f(0.6f * cosf(a), 0.6f * sinf(a), 0.8f);
		glVertex2f(0.9f * cosf(a), 0.9f * sinf(a));
	}
	glEnd();
}

int main(void)
{
	static const struct table tables[] = {
		{ 192, attenuation, draw_cap }, { 180, spot, draw_cap },      { 96, term, draw_cap },  { 64, shininess, draw_cap },
		{ 120, side, draw_side },       { 96, normal, draw_normal }, { 192, many, draw_cap }, { 36, flat, draw_flat },
		{ 192, normal, draw_short_normal },
	};

	DRAW_TABLES(tables, NULL);
	return 0;
}
