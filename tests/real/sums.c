/*
 * The accumulation buffer: sums are kept from frame to frame, and unaffected by selection and feedback. Recorded by
 * test_sums.py.
 */
#include "tests/trace/window.h"

static void reset(void)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, 64, 0, 48, -10, 10);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glClearColor(0.2f, 0.4f, 0.6f, 0.4f);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

static void panel(int x, int y, int size, float r, float g, float b, float a)
{
	glColor4f(r, g, b, a);
	glRecti(x, y, x + size, y + size);
}

/* Load, multiply, accumulate, and return through a scissor and a mask; sums are kept for the next frame. */
static void sums(void)
{
	panel(4, 4, 30, 1, 0, 0.2f, 1);
	glAccum(GL_LOAD, 0.4f);
	glClear(GL_COLOR_BUFFER_BIT);
	panel(14, 14, 30, 0, 1, 0.6f, 1);
	glAccum(GL_ACCUM, 0.6f);
	glEnable(GL_BLEND); /* RETURN ignores blending */
	glBlendFunc(GL_ONE, GL_ONE);
	glAccum(GL_RETURN, 1);
	glDisable(GL_BLEND);
	panel(48, 30, 12, 1, 0.8f, 0.2f, 1); /* over the returned colours */
}

/* Continue with the buffer of the previous frame. */
static void more_sums(void)
{
	glAccum(GL_MULT, 0.5f);
	glEnable(GL_SCISSOR_TEST);
	glScissor(10, 10, 30, 100);
	glAccum(GL_ADD, 0.2f);
	glScissor(0, 0, 50, 40);
	glColorMask(GL_TRUE, GL_TRUE, GL_FALSE, GL_TRUE);
	glAccum(GL_RETURN, 1.5f);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	glDisable(GL_SCISSOR_TEST);
}

/* Selection and feedback neither clear nor scale the sums. */
static void not_rendered(void)
{
	unsigned names[64];
	float numbers[256];

	glClearAccum(0.8f, 0.2f, 0.4f, 1);
	glClear(GL_ACCUM_BUFFER_BIT);
	glSelectBuffer(64, names);
	glFeedbackBuffer(256, GL_3D_COLOR, numbers);
	for (int i = 0; i < 2; i++) {
		glRenderMode(i ? GL_FEEDBACK : GL_SELECT);
		glClearAccum(0, 0, 0, 0);
		glClear(GL_COLOR_BUFFER_BIT | GL_ACCUM_BUFFER_BIT);
		glAccum(GL_MULT, 0.5f);
		glAccum(GL_RETURN, 0.5f);
		glRenderMode(GL_RENDER);
	}
	glEnable(GL_SCISSOR_TEST);
	glScissor(44, 24, 12, 12);
	glAccum(GL_RETURN, 1);
	glDisable(GL_SCISSOR_TEST);
}

int main(void)
{
	static void (*const frames[])(void) = { sums, more_sums, not_rendered };
	int attributes[] = {
		GLX_RGBA, GLX_DOUBLEBUFFER, GLX_ALPHA_SIZE, 1, GLX_DEPTH_SIZE, 1, GLX_STENCIL_SIZE, 1, GLX_ACCUM_RED_SIZE, 1,
		GLX_ACCUM_GREEN_SIZE, 1, GLX_ACCUM_BLUE_SIZE, 1, GLX_ACCUM_ALPHA_SIZE, 1, None
	};

	window_kind = "an accumulation buffer";
	open_window_of(attributes);
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), reset);
	return 0;
}
