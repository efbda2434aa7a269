/*
 * What is drawn to, one thing a frame: a window with alpha, whose stored alpha blends look at. Recorded by test_targets.py.
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

/* Factors that are the stored alpha, masks that keep it, and a test program's usual trick: alpha drawn first. */
static void stored_alpha(void)
{
	glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
	panel(4, 4, 20, 1, 1, 1, 0.8f);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
	glEnable(GL_BLEND);
	glBlendFunc(GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA);
	panel(10, 10, 30, 1, 0.6f, 0, 0.2f);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	glBlendFunc(GL_SRC_ALPHA_SATURATE, GL_ONE);
	panel(30, 5, 25, 0.2f, 0.8f, 0.6f, 0.8f);
	panel(34, 9, 25, 0.8f, 0.2f, 0.6f, 0.8f);
	glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_DST_ALPHA);
	panel(20, 25, 20, 0.4f, 0.6f, 1, 0.6f);
	glDisable(GL_BLEND);
}

int main(void)
{
	static void (*const frames[])(void) = { stored_alpha };
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_ALPHA_SIZE, 1, GLX_DEPTH_SIZE, 1, GLX_STENCIL_SIZE, 1, None };

	open_window_of(attributes);
	for (unsigned i = 0; i < sizeof(frames) / sizeof(frames[0]); i++) {
		reset();
		frames[i]();
		end_frame();
	}
	return 0;
}
