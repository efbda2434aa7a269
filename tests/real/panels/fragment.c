/*
 * Per-fragment operations (OpenGL 2.1 sec. 4.1) and earlier state that discards fragments: three squares at increasing
 * height, the upper two overlapping.
 */
#include "panels.h"

/* Square k, counted from the lowest. */
static void square(int k)
{
	const float x = -0.9f + 0.35f * (float)k, y = -0.9f + 0.3f * (float)k, z = 0.3f - 0.2f * (float)k;

	glBegin(GL_QUADS);
	for (int c = 0; c < 4; c++) {
		const int right = c == 1 || c == 2, top = c >= 2;

		glColor4f(0.9f - 0.38f * (float)k, 0.2f + 0.6f * (float)right, 0.31f + 0.29f * (float)k, top ? 0.85f : 0.15f);
		glTexCoord2f((float)right, (float)top);
		glVertex3f(x + 1.1f * (float)right, y + 1.1f * (float)top, top ? z : z + 0.3f);
	}
	glEnd();
}

static void draw_blended(int i)
{
	(void)i;
	square(0);
	glEnable(GL_BLEND);
	square(1);
	square(2);
}

static const GLenum factors[15] = {
	GL_ZERO, GL_ONE, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_DST_COLOR, GL_ONE_MINUS_DST_COLOR, GL_SRC_ALPHA,
	GL_ONE_MINUS_SRC_ALPHA, GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA, GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR,
	GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_SRC_ALPHA_SATURATE
};

/* Each source factor with each destination factor; the first twelve factors, and those from the fourth on. */
static void factor(int i, int first)
{
	const int source = choose(&i, 15), target = first + choose(&i, 12);

	glBlendColor(0.3f, 0.8f, 0.5f, 0.6f);
	glBlendFunc(factors[source], factors[target]);
}

static void factor_low(int i)
{
	factor(i, 0);
}

static void factor_high(int i)
{
	factor(i, 2);
}

/* Equations, and separate factors and equations for alpha. */
static void equation(int i)
{
	static const GLenum equations[5] = { GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX };
	const int rgb = choose(&i, 5), alpha = choose(&i, 5), how = choose(&i, 4);

	glBlendColor(0.3f, 0.8f, 0.5f, 0.6f);
	glBlendEquationSeparate(equations[rgb], equations[alpha]);
	glBlendFuncSeparate(factors[how + 4], factors[how], factors[6 + how], factors[11 - how]);
}

/* Afterwards another square shows the alpha that was stored. */
static void draw_equation(int i)
{
	draw_blended(i);
	glBlendEquation(GL_FUNC_ADD);
	glBlendFunc(GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA);
	glTranslatef(0.3f, 0.1f, 0.4f);
	square(0);
}

static const GLenum comparisons[8] = { GL_NEVER,   GL_LESS,     GL_EQUAL,  GL_LEQUAL,
	                               GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS };

static void draw_squares(int i)
{
	(void)i;
	for (int k = 0; k < 3; k++)
		square(k);
}

/* Alpha and depth tests, depth ranges, masks, logic ops, culling, stipple, offset. */
static void test(int i)
{
	const int what = i / 16, how = i % 16, c = how % 8;

	glEnable(GL_DEPTH_TEST);
	if (what == 0) {
		glEnable(GL_ALPHA_TEST);
		glAlphaFunc(comparisons[c], how < 8 ? 0.5f : 0.3f);
	} else if (what == 1) {
		glDepthFunc(comparisons[c]);
		glDepthMask(how < 8);
	} else if (what == 2) {
		glDepthRange(0.1 * c, how < 8 ? 1 - 0.1 * c : 0.4);
	} else if (what == 3) {
		glColorMask(how & 1, how >> 1 & 1, how >> 2 & 1, how >> 3 & 1);
	} else if (what == 4) {
		glEnable(GL_COLOR_LOGIC_OP);
		glLogicOp(GL_CLEAR + (unsigned)how);
	} else if (what == 5) {
		glEnable(GL_CULL_FACE);
		glCullFace(c % 3 == 0 ? GL_FRONT : c % 3 == 1 ? GL_BACK : GL_FRONT_AND_BACK);
		glFrontFace(c & 1 ? GL_CW : GL_CCW);
		glPolygonMode(GL_FRONT, c & 2 ? GL_LINE : GL_FILL);
		glPolygonMode(GL_BACK, c & 4 ? GL_POINT : GL_FILL);
		if (how >= 8)
			glScalef(-1, 1, 1);
	} else if (what == 6) {
		unsigned char bits[128];

		for (unsigned k = 0; k < 128; k++)
			bits[k] = (unsigned char)(256 * noise(k + 128 * (unsigned)how));
		glEnable(GL_POLYGON_STIPPLE);
		glPolygonStipple(bits);
	} else {
		glEnable(how < 8 ? GL_POLYGON_OFFSET_FILL : GL_POLYGON_OFFSET_LINE);
		glPolygonOffset((float)(c - 4), (float)(3 * c));
		glPolygonMode(GL_FRONT_AND_BACK, how & 1 ? GL_LINE : GL_FILL);
	}
}

static const GLenum operations[8] = { GL_KEEP,      GL_ZERO, GL_REPLACE,   GL_INCR,
	                              GL_INCR_WRAP, GL_DECR, GL_DECR_WRAP, GL_INVERT };

/* Stencil functions, operations for each of the three outcomes, masks and values at the ends of their range. */
static void stencil(int i)
{
	const int function = choose(&i, 8), operation = choose(&i, 8), place = choose(&i, 3);

	glEnable(GL_DEPTH_TEST);
	glEnable(GL_STENCIL_TEST);
	glClearStencil(operation & 1 ? 255 : 0);
	glClear(GL_STENCIL_BUFFER_BIT);
	glStencilMask(place == 1 ? 0x37 : 0xff);
	glStencilFunc(comparisons[function], 0x15, place == 2 ? 0x1c : 0xff);
	glStencilOp(operations[place == 0 ? operation : 2], operations[place == 1 ? operation : 3],
	            operations[place == 2 ? operation : 7]);
}

/* Show the final stencil values in four ranges. */
static void show_stencil(void)
{
	glDisable(GL_DEPTH_TEST);
	glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
	glEnable(GL_BLEND);
	glBlendFunc(GL_ONE, GL_ONE);
	for (int bit = 0; bit < 8; bit++) {
		const float c = 0.5f / (float)(1 << bit % 4);

		glStencilFunc(GL_EQUAL, 255, 1u << bit);
		glColor3f(bit < 4 ? c : 0, bit < 4 ? 0 : c, 0);
		glRectf(-1, -1, 1, 1);
	}
}

static void draw_stencilled(int i)
{
	draw_squares(i);
	show_stencil();
}

/* Two-sided stencil (sec. 4.1.4): back faces decrement, front faces increment. */
static void sided(int i)
{
	const int front = choose(&i, 8), back = choose(&i, 8);

	glEnable(GL_STENCIL_TEST);
	glClearStencil(3);
	glClear(GL_STENCIL_BUFFER_BIT);
	glStencilFuncSeparate(GL_FRONT, GL_LEQUAL, 2, 0xff);
	glStencilFuncSeparate(GL_BACK, GL_GEQUAL, 4, 0x7f);
	glStencilOpSeparate(GL_FRONT, operations[back], GL_ZERO, operations[front]);
	glStencilOpSeparate(GL_BACK, operations[front], GL_ZERO, operations[back]);
	glStencilMaskSeparate(GL_BACK, 0x0f);
}

static void draw_sided(int i)
{
	draw_squares(i);
	glScalef(-1, 1, 1);
	draw_squares(i);
	glScalef(-1, 1, 1);
	glStencilMask(0xff);
	show_stencil();
}

/* User clip planes (sec. 2.12), one to six of them; points and lines are clipped, too. */
static void clipped(int i)
{
	const int n = 1 + choose(&i, 6), turn = choose(&i, 4), mode = choose(&i, 3);

	for (int k = 0; k < n; k++) {
		glRotatef(17 + 11 * (float)turn, 0.1f, 0.2f, 1);
		glClipPlane(GL_CLIP_PLANE0 + (unsigned)k, (const double[4]){ k % 2 ? 1 : -0.6, 0.4, 0.1 * k, 0.8 });
		glEnable(GL_CLIP_PLANE0 + (unsigned)k);
	}
	for (int k = 0; k < n; k++)
		glRotatef(-17 - 11 * (float)turn, 0.1f, 0.2f, 1);
	glPolygonMode(GL_FRONT_AND_BACK, mode == 0 ? GL_FILL : mode == 1 ? GL_LINE : GL_POINT);
	glPointSize(3);
}

/* Geometry that crosses the near plane, with an edge on it; also as lines and points. */
static void nearby(int i)
{
	const int mode = choose(&i, 3), tilt = choose(&i, 8), turn = choose(&i, 3);

	glTranslatef(0, 0, 1.2f);
	glRotatef(50 * (float)turn, 0.2f, 1, 0.4f);
	glRotatef(25 + 15 * (float)tilt, 1, 0.3f, 0.1f);
	glScalef(1.7f, 1.7f, 1.7f);
	glPolygonMode(GL_FRONT_AND_BACK, mode == 0 ? GL_FILL : mode == 1 ? GL_LINE : GL_POINT);
	glLineWidth(tilt & 1 ? 3 : 1);
	glPointSize(3);
}

/* Alpha equal to the reference, and one code on either side. */
static void at_reference(int i)
{
	static const int codes[8] = { 1, 2, 77, 102, 127, 128, 204, 254 };
	const int comparison = choose(&i, 8), code = codes[choose(&i, 8)], beside = choose(&i, 3) - 1;

	glEnable(GL_ALPHA_TEST);
	glAlphaFunc(comparisons[comparison], (float)code / 255.0f);
	glColor4ub(240, 200, 60, (GLubyte)(code + beside));
}

static void draw_plain(int i)
{
	(void)i;
	glRectf(-0.8f, -0.8f, 0.8f, 0.8f);
}

int main(void)
{
	static const struct table tables[] = {
		{ 180, factor_low, draw_blended }, { 180, factor_high, draw_blended }, { 100, equation, draw_equation },
		{ 128, test, draw_squares }, { 192, stencil, draw_stencilled }, { 64, sided, draw_sided },
		{ 72, clipped, draw_squares }, { 72, nearby, draw_squares }, { 192, at_reference, draw_plain },
	};

	DRAW_TABLES(tables, NULL);
	return 0;
}
