/* Fog and colour sum (OpenGL 2.1 sec. 3.9 and 3.10) on a slope that recedes from the viewer. */
#include "panels.h"

static void slope(float near, float far)
{
	for (int k = 0; k < 4; k++) {
		const int right = k == 1 || k == 2, back = k >= 2;

		glColor4f(0.9f, 0.2f + 0.6f * (float)right, 0.1f, 0.3f + 0.5f * (float)back);
		glSecondaryColor3f(0.3f * (float)right, 0.5f, 0.6f * (float)back);
		glFogCoordf(right ? 2.5f * (float)back : 0.4f + (float)back);
		glVertex3f(right ? 1.5f : -1.5f, back ? 1 : -1, back ? far : near);
	}
}

static void draw_slope(int i)
{
	(void)i;
	glBegin(GL_QUADS);
	slope(0.8f, -9);
	glEnd();
}

static void fog_color(float r, float g, float b, float a)
{
	glFogfv(GL_FOG_COLOR, (const float[4]){ r, g, b, a });
}

/* Each mode, density or range, by depth and by coordinates, with and without colour sum. */
static void mode(int i)
{
	static const GLenum modes[3] = { GL_EXP, GL_EXP2, GL_LINEAR };
	static const float densities[4] = { 0.1f, 0, 0.35f, 1.5f },
			   ranges[4][2] = { { 1, 8 }, { 0, 1 }, { 6, 2 }, { -1, 12 } };
	const int m = choose(&i, 3), how = choose(&i, 4), by_coordinates = choose(&i, 2), sum = choose(&i, 2),
		  texture = choose(&i, 2);

	glEnable(GL_FOG);
	glFogi(GL_FOG_MODE, (GLint)modes[m]);
	glFogf(GL_FOG_DENSITY, densities[how]);
	glFogf(GL_FOG_START, ranges[how][0]);
	glFogf(GL_FOG_END, ranges[how][1]);
	glFogi(GL_FOG_COORD_SRC, by_coordinates ? GL_FOG_COORD : GL_FRAGMENT_DEPTH);
	if (sum)
		glEnable(GL_COLOR_SUM);
	fog_color(0.2f, 0.4f, texture ? 0.9f : 0.1f, 0.5f);
}

/* Ways of measuring fog distance (NV_fog_distance); half of the slope is to the viewer's side. */
static void distance(int i)
{
	static const GLenum distances[3] = { GL_EYE_RADIAL_NV, GL_EYE_PLANE, GL_EYE_PLANE_ABSOLUTE_NV };
	const int d = choose(&i, 3), aside = choose(&i, 2);

	mode(i);
	glFogi(GL_FOG_COORD_SRC, GL_FRAGMENT_DEPTH);
	glFogi(GL_FOG_DISTANCE_MODE_NV, (GLint)distances[d]);
	glTranslatef(aside ? 0.8f : 0, 0, 0);
}

/* Fog colours outside [0, 1]; orthographic projections; alpha, which fog leaves unchanged. */
static void colored(int i)
{
	const int r = choose(&i, 3), ortho = choose(&i, 2), blend = choose(&i, 2), sum = choose(&i, 2), flat = choose(&i, 2);

	glEnable(GL_FOG);
	glFogf(GL_FOG_DENSITY, 0.3f);
	fog_color(r == 0 ? -0.5f : 0.3f, r == 1 ? 2 : 0.6f, 0.8f, r == 2 ? 0 : 1);
	if (ortho) {
		glMatrixMode(GL_PROJECTION);
		glLoadIdentity();
		glOrtho(-1.2, 1.2, -1.2, 1.2, -3, 13);
		glMatrixMode(GL_MODELVIEW);
	}
	if (blend) {
		glEnable(GL_BLEND);
		glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	}
	if (sum)
		glEnable(GL_COLOR_SUM);
	glShadeModel(flat ? GL_FLAT : GL_SMOOTH);
}

/* Lit colours and highlights, separate or not, above 1 before fog. */
static void lit(int i)
{
	static const float white[4] = { 1, 1, 1, 1 }, bright[4] = { 2.5f, 1.5f, 0.8f, 1 };
	const int apart = choose(&i, 2), vertex = choose(&i, 3), fragment = choose(&i, 3), m = choose(&i, 2),
		  sum = choose(&i, 2);
	static const GLenum clamps[3] = { GL_TRUE, GL_FALSE, GL_FIXED_ONLY };

	mode(m + 6);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[4]){ 0, 0.5f, 1, 0 });
	glLightfv(GL_LIGHT0, GL_DIFFUSE, bright);
	glMaterialfv(GL_FRONT, GL_DIFFUSE, bright);
	glMaterialfv(GL_FRONT, GL_SPECULAR, white);
	glMaterialf(GL_FRONT, GL_SHININESS, 2);
	glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, apart ? GL_SEPARATE_SPECULAR_COLOR : GL_SINGLE_COLOR);
	if (sum)
		glEnable(GL_COLOR_SUM);
	glClampColorARB(GL_CLAMP_VERTEX_COLOR_ARB, clamps[vertex]);
	glClampColorARB(GL_CLAMP_FRAGMENT_COLOR_ARB, clamps[fragment]);
}

static void draw_lit(int i)
{
	(void)i;
	glBegin(GL_QUADS);
	glNormal3f(0, 0.7f, 0.7f);
	slope(0.8f, -9);
	glEnd();
}

/* Points and lines, images and bitmaps: fog of primitives with one depth. */
static void other(int i)
{
	mode(i % 12);
	glPointSize(5);
	glLineWidth(3);
}

static void draw_other(int i)
{
	static const unsigned char
		pixels[4 * 4] = { 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 128 },
			   bits[4] = { 0xf0, 0x90, 0x90, 0xf0 };

	if (i / 12 < 2) {
		glBegin(i / 12 ? GL_LINES : GL_POINTS);
		slope(0.8f, -6);
		glEnd();
		return;
	}
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glColor3f(0.9f, 0.5f, 0.2f);
	glFogCoordf(0.7f);
	glRasterPos3f(-0.5f, -0.5f, -1);
	glPixelZoom(3, 3);
	if (i / 12 == 2)
		glDrawPixels(2, 2, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
	else
		glBitmap(4, 4, 0, 0, 0, 0, bits);
}

int main(void)
{
	static const struct table tables[] = { { 96, mode, draw_slope },
		                               { 48, colored, draw_slope },
		                               { 72, lit, draw_lit },
		                               { 48, other, draw_other },
		                               { 72, distance, draw_slope } };

	DRAW_TABLES(tables, NULL);
	return 0;
}
