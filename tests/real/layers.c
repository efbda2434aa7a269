/*
 * Frames of several looks (kernels/frame/plain/plain.h): overlapping walls in a lit room, with all blend factors, all
 * alpha and depth functions and write masks; and a second projection over them. From frame 5 on colours are not
 * cleared: the old picture is covered by a sky, or shows; frame 8 copies its own picture so far. Recorded by
 * test_layers.py.
 */
#include "tests/trace/window.h"

static const GLenum factors[] = {
	GL_ZERO, GL_ONE, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_DST_COLOR, GL_ONE_MINUS_DST_COLOR, GL_SRC_ALPHA,
	GL_ONE_MINUS_SRC_ALPHA, GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA, GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR,
	GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_SRC_ALPHA_SATURATE
};
static const GLenum equations[] = { GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX };

static int below(int n)
{
	return (rand() >> 4) % n;
}

static float number(void)
{
	return (float)below(1001) / 1000;
}

static GLenum factor(int n)
{
	return factors[below(n)];
}

/* Fragment state for a wall. kind: that of the frame */
static void choose(int kind)
{
	const int usual = below(3) == 0;

	glColor4f(number(), number(), number(), below(3) ? number() : 1);
	(below(4) ? glEnable : glDisable)(GL_BLEND);
	glBlendColor(number(), number(), number(), number());
	glBlendFuncSeparate(usual ? GL_SRC_ALPHA : factor(15), usual ? GL_ONE_MINUS_SRC_ALPHA : factor(14),
	                    usual ? GL_SRC_ALPHA : factor(15), usual ? GL_ONE_MINUS_SRC_ALPHA : factor(14));
	glBlendEquationSeparate(equations[usual ? 0 : below(5)], equations[usual ? 0 : below(5)]);
	(kind > 0 && below(3) == 0 ? glEnable : glDisable)(GL_ALPHA_TEST);
	glAlphaFunc(GL_NEVER + (GLenum)below(8), number());
	(below(4) ? glEnable : glDisable)(GL_DEPTH_TEST);
	glDepthFunc(kind > 1 ? GL_NEVER + (GLenum)below(8) : below(2) ? GL_LESS : GL_LEQUAL);
	glDepthMask(below(3) != 0);
	glColorMask(below(6) != 0, below(6) != 0, below(6) != 0, below(6) != 0);
	(below(4) ? glEnable : glDisable)(GL_LIGHTING);
}

static void wall(void)
{
	const float x = 3 * number() - 2, y = 3 * number() - 2, z = -2 - 3 * number(), turn = number() - 0.5f;

	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		const float right = i == 1 || i == 2 ? 1.5f : 0, up = i > 1 ? 1.5f : 0;

		glNormal3f(-turn, 0, 1);
		glVertex3f(x + right, y + up, z + turn * right);
	}
	glEnd();
}

static void project(int perspective)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	if (perspective)
		glFrustum(-0.6, 0.6, -0.6, 0.6, 1, 9);
	else
		glOrtho(-3, 3, -3, 3, 1, 9);
	glMatrixMode(GL_MODELVIEW);
}

/* Fill the window with one colour, using a blend mode that keeps nothing of the old contents. */
static void sky(void)
{
	glDisable(GL_DEPTH_TEST);
	glDisable(GL_LIGHTING);
	glEnable(GL_BLEND);
	glBlendFunc(GL_ONE, GL_ZERO);
	glBlendEquation(GL_FUNC_ADD);
	glColor4f(0.4f, 0.6f, 0.8f, 0.5f);
	glRectf(-3, -3, 3, 3);
}

/* Copy the picture so far to a texture, and show it on a wall. */
static void copy(void)
{
	glDisable(GL_BLEND);
	glEnable(GL_TEXTURE_2D);
	glEnable(GL_TEXTURE_GEN_S);
	glEnable(GL_TEXTURE_GEN_T);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 0, 0, 64, 32, 0);
	wall();
	glDisable(GL_TEXTURE_2D);
}

int main(void)
{
	static const float place[] = { 1, 2, 1, 1 };

	window_size[0] = 75; /* rows do not end at a multiple of sixteen pixels */
	window_size[1] = 53;
	open_window();
	glEnable(GL_LIGHT0);
	glEnable(GL_COLOR_MATERIAL);
	glLightfv(GL_LIGHT0, GL_POSITION, place);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
	for (int frame = 0; frame < 9; frame++) {
		srand(5 + (unsigned)frame);
		glColorMask(1, 1, 1, 1);
		glDepthMask(1);
		glClearColor(0.2f, 0.3f, 0.5f, 0.5f);
		glClear(GL_DEPTH_BUFFER_BIT | (frame < 5 ? GL_COLOR_BUFFER_BIT : 0));
		project(0);
		glTranslatef(0, 0, -2);
		if (frame == 5 || frame == 8)
			sky();
		glLoadIdentity();
		for (int i = 0; i < (frame > 2 ? 50 : 14); i++) {
			project(i < (frame == 4 ? 25 : 10) || frame == 3);
			choose(frame);
			if (frame == 4 && i >= 25) { /* an overlay that rays do not see */
				glDisable(GL_DEPTH_TEST);
				glDisable(GL_LIGHTING);
			}
			wall();
			if (frame == 8 && i % 10 == 5)
				copy();
		}
		end_frame();
	}
	return 0;
}
