/*
 * Texture environments, combiners and generated coordinates (OpenGL 2.1 sec. 2.11.4, 3.8): a tilted square with one or
 * two texture units.
 */
#include <math.h>

#include "panels.h"

enum { FORMATS = 6 };
static const GLenum formats[FORMATS] = { GL_ALPHA, GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_INTENSITY, GL_RGB, GL_RGBA };
static GLuint textures[FORMATS], cube_map;
static float turned, reach; /* target of the cube map's panels: angle in degrees, and extent around it */

static void fill(unsigned char *texels, unsigned n, unsigned seed)
{
	for (unsigned i = 0; i < n; i++)
		texels[i] = (unsigned char)(255.9f * noise(i + seed));
}

static void prepare(void)
{
	unsigned char texels[8 * 8 * 4];

	glGenTextures(FORMATS, textures);
	for (unsigned f = 0; f < FORMATS; f++) {
		fill(texels, sizeof(texels), 1000 * f);
		glBindTexture(GL_TEXTURE_2D, textures[f]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, f % 2 ? GL_NEAREST : GL_LINEAR);
		glTexImage2D(GL_TEXTURE_2D, 0, (GLint)formats[f], 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	}
	glGenTextures(1, &cube_map);
	glBindTexture(GL_TEXTURE_CUBE_MAP, cube_map);
	for (unsigned face = 0; face < 6; face++)
		for (int level = 0; level < 4; level++) {
			fill(texels, sizeof(texels), 9000 + 100 * face + (unsigned)level);
			glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, level, GL_RGBA, 8 >> level, 8 >> level, 0,
			             GL_RGBA, GL_UNSIGNED_BYTE, texels);
		}
}

static void unit(unsigned u, unsigned f)
{
	glActiveTexture(GL_TEXTURE0 + u);
	glEnable(GL_TEXTURE_2D);
	glBindTexture(GL_TEXTURE_2D, textures[f]);
	glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, (const float[4]){ 0.2f, 0.7f, 0.4f, 0.3f });
}

static void draw_square(int i)
{
	(void)i;
	glBegin(GL_QUADS);
	for (int k = 0; k < 4; k++) {
		const float u = k == 1 || k == 2, v = k >= 2;

		glColor4f(0.2f + 0.7f * u, 0.9f - 0.6f * v, 0.5f, 0.3f + 0.6f * u);
		glSecondaryColor3f(0.5f * v, 0.1f, 0.3f * u);
		glNormal3f(u - 0.5f, v - 0.5f, 0.8f);
		glMultiTexCoord4f(GL_TEXTURE0, 1.5f * u - 0.2f, 1.2f * v, 0.3f, 1 + 0.5f * v);
		glMultiTexCoord4f(GL_TEXTURE1, v, 1 - u, 0.7f, 1);
		glVertex3f(2 * u - 1, 2 * v - 1, -v);
	}
	glEnd();
}

/* Each mode with each base format, on one unit and on a second. */
static void environment(int i)
{
	static const GLint modes[5] = { GL_MODULATE, GL_DECAL, GL_BLEND, GL_REPLACE, GL_ADD };
	const int mode = choose(&i, 5), format = choose(&i, FORMATS), second = choose(&i, 2), how = choose(&i, 3);

	unit(0, (unsigned)(second ? (format + 3) % FORMATS : format));
	if (second)
		unit(1, (unsigned)format);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, modes[mode]);
	if (how == 1)
		glEnable(GL_COLOR_SUM);
	if (how == 2) { /* make alpha visible */
		glEnable(GL_BLEND);
		glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	}
}

static void combine(GLenum function, GLenum function_alpha)
{
	static const GLint sources[3] = { GL_TEXTURE, GL_PREVIOUS, GL_CONSTANT };

	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
	glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, (GLint)function);
	glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_ALPHA, (GLint)function_alpha);
	for (unsigned k = 0; k < 3; k++) {
		glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB + k, sources[k]);
		glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_ALPHA + k, sources[k]);
		glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND0_RGB + k, k == 2 ? GL_SRC_ALPHA : GL_SRC_COLOR);
		glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND0_ALPHA + k, GL_SRC_ALPHA);
	}
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

static const GLenum functions[10] = { GL_REPLACE,  GL_MODULATE, GL_ADD,       GL_ADD_SIGNED,   GL_INTERPOLATE,
	                              GL_SUBTRACT, GL_DOT3_RGB, GL_DOT3_RGBA, GL_DOT3_RGB_EXT, GL_DOT3_RGBA_EXT };

/* Each colour and alpha function with each scale. */
static void function(int i)
{
	const int f = choose(&i, 10), alpha = choose(&i, 6), scale = choose(&i, 3);

	unit(0, 5);
	combine(functions[f], functions[alpha]);
	glTexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, (float)(1 << scale));
	glTexEnvf(GL_TEXTURE_ENV, GL_ALPHA_SCALE, (float)(4 >> scale));
}

/* Each operand of each source for each argument, including all sources. */
static void operand(int i)
{
	static const GLint sources[6] = { GL_TEXTURE, GL_PREVIOUS, GL_CONSTANT, GL_PRIMARY_COLOR, GL_TEXTURE0, GL_TEXTURE1 };
	static const GLint operands[4] = { GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA };
	const int source = choose(&i, 6), op = choose(&i, 4), arg = choose(&i, 3), format = choose(&i, 2);

	unit(0, format ? 2 : 5);
	unit(1, 4);
	combine(GL_INTERPOLATE, GL_INTERPOLATE);
	glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB + (unsigned)arg, sources[source]);
	glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND0_RGB + (unsigned)arg, operands[op]);
	glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_ALPHA + (unsigned)arg, sources[source]);
	glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND0_ALPHA + (unsigned)arg, operands[op | 2]);
}

/* Each generation mode for each coordinate, under texture and modelview matrices. */
static void generated(int i)
{
	static const GLint modes[5] = { GL_OBJECT_LINEAR, GL_EYE_LINEAR, GL_SPHERE_MAP, GL_NORMAL_MAP, GL_REFLECTION_MAP };
	static const float planes[4][4] = {
		{ 0.5f, 0.1f, 0, 0.9f }, { 0, 0.6f, 0.3f, 0.4f }, { 0.2f, 0, 0.7f, 0.1f }, { 0.1f, 0.2f, 0, 1 }
	};
	const int mode = choose(&i, 5), which = choose(&i, 4), matrix = choose(&i, 3), turn = choose(&i, 2);

	unit(0, 4); /* linear filtering avoids ties */
	if (turn)
		glRotatef(25, 0.3f, 1, 0.1f);
	for (unsigned c = 0; c < 4; c++) {
		/* sphere maps have two coordinates, the other modes of this kind three */
		const int has = mode == 2 ? c < 2 : mode > 2 ? c < 3 : 1;

		glTexGeni(GL_S + c, GL_TEXTURE_GEN_MODE, has ? modes[mode] : GL_OBJECT_LINEAR);
		glTexGenfv(GL_S + c, GL_OBJECT_PLANE, planes[c]);
		glTexGenfv(GL_S + c, GL_EYE_PLANE, planes[(c + 1) % 4]);
		if (has && (which == 3 || c <= (unsigned)which))
			glEnable(GL_TEXTURE_GEN_S + c);
	}
	if (turn)
		glRotatef(-25, 0.3f, 1, 0.1f);
	glMatrixMode(GL_TEXTURE);
	glLoadIdentity();
	if (matrix == 1)
		glScalef(0.7f, -1.3f, 1);
	if (matrix == 2)
		glMultMatrixf((const float[16]){ 1, 0.2f, 0, 0, -0.3f, 0.8f, 0, 0.2f, 0, 0, 1, 0, 0.1f, 0.4f, 0, 1.1f });
	glMatrixMode(GL_MODELVIEW);
}

static void draw_generated(int i)
{
	draw_square(i);
	glMatrixMode(GL_TEXTURE);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
}

/* Each combination of cube map filters, magnified and minified. */
static void cube(int i)
{
	static const GLint filters[6] = {
		GL_NEAREST, GL_LINEAR, GL_NEAREST_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_NEAREST, GL_NEAREST_MIPMAP_LINEAR,
		GL_LINEAR_MIPMAP_LINEAR
	};
	const int smaller = choose(&i, 6), larger = choose(&i, 2), turn = choose(&i, 4), far = choose(&i, 3);

	glEnable(GL_TEXTURE_CUBE_MAP);
	glBindTexture(GL_TEXTURE_CUBE_MAP, cube_map);
	glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, filters[smaller]);
	glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, filters[larger]);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	turned = 35 * (float)turn + 20;
	reach = 0.3f + (float)far;
}

static void draw_cube(int i)
{
	(void)i;
	glBegin(GL_QUADS);
	for (int k = 0; k < 4; k++) {
		const float u = k == 1 || k == 2 ? 1.0f : -1.0f, v = k >= 2 ? 1.0f : -1.0f, s = sinf(turned / 57.3f),
			    c = cosf(turned / 57.3f);

		glTexCoord3f(reach * u * c + s, reach * v, c - reach * u * s);
		glVertex3f(u, v, -0.3f * v);
	}
	glEnd();
}

int main(void)
{
	static const struct table tables[] = {
		{ 180, environment, draw_square }, { 180, function, draw_square }, { 144, operand, draw_square },
		{ 120, generated, draw_generated }, { 144, cube, draw_cube },
	};

	DRAW_TABLES(tables, prepare);
	return 0;
}
