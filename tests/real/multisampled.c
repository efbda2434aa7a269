/*
 * A window with four samples per pixel, as displayed by the X server: edges in all directions, with multisampling on,
 * off, and on again. After each swap the window is read from the server, as RGB rows from the top down, and appended to
 * the file named by the argument. Exits with 77 if there is no such visual.
 */
#include <math.h>

#include "tests/trace/window.h"

enum { WIDTH = 64, HEIGHT = 48, FRAMES = 4 };

static void fan(int n)
{
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < n; i++) {
		float from = 6.2831853f * (float)i / (float)n, to = from + 3.0f / (float)n;

		glColor3f(1.0f - (float)i / (float)n, 0.3f, (float)i / (float)n);
		glVertex3f(0, 0, (float)i / (float)n - 0.5f);
		glVertex3f(0.95f * cosf(from), 0.95f * sinf(from), 0);
		glVertex3f(0.95f * cosf(to), 0.95f * sinf(to), 0);
	}
	glEnd();
}

static void draw(int frame)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	if (frame == 1)
		glDisable(GL_MULTISAMPLE);
	else
		glEnable(GL_MULTISAMPLE);
	glLoadIdentity();
	glRotatef(7.0f * (float)frame, 0, 0, 1);
	fan(9 + 4 * frame);
	glColor3f(1, 1, 1);
	glBegin(GL_LINES);
	glVertex2f(-0.9f, -0.7f);
	glVertex2f(0.8f, 0.9f);
	glEnd();
}

static unsigned framebuffer, renderbuffer;

/* State that reading the window must not change. */
static void set_state(int on)
{
	if (on && !framebuffer) {
		glGenFramebuffers(1, &framebuffer);
		glGenRenderbuffers(1, &renderbuffer);
	}
	glBindFramebuffer(GL_FRAMEBUFFER, on ? framebuffer : 0);
	glBindRenderbuffer(GL_RENDERBUFFER, on ? renderbuffer : 0);
	if (on)
		glEnable(GL_SCISSOR_TEST);
	else
		glDisable(GL_SCISSOR_TEST);
	glScissor(3, 3, 9, 9);
}

static unsigned get(unsigned what)
{
	int value = -1;

	glGetIntegerv(what, &value);
	return (unsigned)value;
}

static void expect_state(void)
{
	expect(get(GL_DRAW_FRAMEBUFFER_BINDING) == framebuffer && get(GL_READ_FRAMEBUFFER_BINDING) == framebuffer,
	       "the framebuffer is bound");
	expect(get(GL_RENDERBUFFER_BINDING) == renderbuffer, "the renderbuffer is bound");
	expect(glIsEnabled(GL_SCISSOR_TEST) && !glIsEnabled(GL_FRAMEBUFFER_SRGB), "scissoring is on, encoding off");
	expect(glGetError() == GL_NO_ERROR, "there is no error");
}

/* The server's copy of the window. */
static void append_shown(FILE *file)
{
	XImage *image;

	glXWaitGL();
	XSync(display, False);
	image = XGetImage(display, window, 0, 0, WIDTH, HEIGHT, AllPlanes, ZPixmap);
	expect(image != NULL, "the window can be read");
	for (int y = 0; y < HEIGHT; y++)
		for (int x = 0; x < WIDTH; x++) {
			unsigned long pixel = XGetPixel(image, x, y);

			for (int shift = 16; shift >= 0; shift -= 8)
				fputc((int)(pixel >> shift & 255), file);
		}
	XDestroyImage(image);
}

int main(int argc, char **argv)
{
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 1, GLX_SAMPLE_BUFFERS, 1, GLX_SAMPLES, 4, None };
	int samples = 0;
	FILE *file = argc > 1 ? fopen(argv[1], "wb") : NULL;

	window_kind = "four samples a pixel";
	open_window_of(attributes);
	glGetIntegerv(GL_SAMPLES, &samples);
	expect(samples == 4, "four samples a pixel");
	glEnable(GL_DEPTH_TEST);
	glClearColor(0.1f, 0.4f, 0.2f, 1);
	for (int frame = 0; frame < FRAMES; frame++) {
		draw(frame);
		set_state(frame > 1);
		end_frame();
		if (frame > 1)
			expect_state();
		set_state(0);
		if (file)
			append_shown(file);
	}
	return file && fclose(file) ? 1 : 0;
}
