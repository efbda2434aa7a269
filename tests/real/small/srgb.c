/*
 * GL_FRAMEBUFFER_SRGB (EXT_framebuffer_sRGB): clears, shading, blending and pixel rectangles in an sRGB-capable window,
 * and framebuffer objects of several formats. One frame each; recorded by test_small.py.
 */
#include "tests/trace/window.h"

static void before(void)
{
	glDisable(GL_FRAMEBUFFER_SRGB);
	glDisable(GL_BLEND);
	glDisable(GL_LIGHTING);
	glDisable(GL_TEXTURE_2D);
	glClearColor(0.2f, 0.1f, 0.4f, 0.5f);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_FRAMEBUFFER_SRGB);
}

static void rectangle(float x, float y, float w, float h)
{
	glBegin(GL_QUADS);
	glTexCoord2f(0, 0);
	glVertex2f(x, y);
	glTexCoord2f(1, 0);
	glVertex2f(x + w, y);
	glTexCoord2f(1, 1);
	glVertex2f(x + w, y + h);
	glTexCoord2f(0, 1);
	glVertex2f(x, y + h);
	glEnd();
}

static void shades(void)
{
	glClear(GL_COLOR_BUFFER_BIT);
	glBegin(GL_QUADS);
	glColor4f(1, 0, 0, 1);
	glVertex2f(-0.8f, -0.8f);
	glColor4f(0, 1, 0, 0.5f);
	glVertex2f(0.8f, -0.8f);
	glColor4f(0, 0.002f, 0.1f, 0.3f);
	glVertex2f(0.8f, 0.8f);
	glColor4f(0.1f, 0.5f, 0.9f, 0.7f);
	glVertex2f(-0.8f, 0.8f);
	glEnd();
}

static void blends(void)
{
	static const GLenum factors[4][2] = { { GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA },
		                              { GL_ONE, GL_ONE },
		                              { GL_DST_COLOR, GL_ZERO },
		                              { GL_ONE_MINUS_DST_COLOR, GL_SRC_COLOR } };

	shades();
	glEnable(GL_BLEND);
	for (int i = 0; i < 4; i++) {
		glBlendFunc(factors[i][0], factors[i][1]);
		glColor4f(0.5f, 0.3f, 0.2f, 0.4f);
		rectangle(-0.9f + 0.4f * (float)i, -0.9f, 0.6f, 1.8f);
	}
}

static void pixels(void)
{
	static float of[16][3];

	for (int i = 0; i < 16; i++)
		for (int k = 0; k < 3; k++)
			of[i][k] = (float)(3 * i + k) / 48;
	shades();
	glPixelZoom(4, 4);
	glRasterPos2f(-0.9f, -0.9f);
	glDrawPixels(4, 4, GL_RGB, GL_FLOAT, of);
	glRasterPos2f(0, 0);
	glCopyPixels(4, 4, 6, 6, GL_COLOR);
	glPixelZoom(1, 1);
	glDisable(GL_FRAMEBUFFER_SRGB);
	glColor3f(0.5f, 0.5f, 0.5f);
	rectangle(0.5f, -0.9f, 0.4f, 0.4f);
}

static void lit_and_textured(void)
{
	static const GLubyte texels[4][3] = { { 255, 200, 20 }, { 20, 60, 90 }, { 128, 128, 128 }, { 5, 250, 250 } };
	GLuint texture;

	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	for (int i = 0; i < 2; i++) {
		glTexImage2D(GL_TEXTURE_2D, 0, i ? GL_SRGB8 : GL_RGB8, 2, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
		glEnable(GL_TEXTURE_2D);
		glEnable(GL_LIGHTING);
		glEnable(GL_LIGHT0);
		glNormal3f(0, 0.6f, 0.8f);
		rectangle((float)i - 0.95f, -0.9f, 0.9f, 1.8f);
	}
}

/* Draw into a texture, then show it. */
static void through(GLint format)
{
	GLuint framebuffer, texture;

	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexImage2D(GL_TEXTURE_2D, 0, format, 64, 48, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glGenFramebuffers(1, &framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
	blends();
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glDisable(GL_BLEND);
	glEnable(GL_TEXTURE_2D);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	rectangle(-1, -1, 2, 2);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
}

static void through_srgb(void)
{
	through(GL_SRGB8_ALPHA8);
}

static void through_plain(void)
{
	through(GL_RGBA8);
}

static void through_floats(void)
{
	through(GL_RGBA32F_ARB);
}

static void pushed(void)
{
	glPushAttrib(GL_COLOR_BUFFER_BIT);
	glDisable(GL_FRAMEBUFFER_SRGB);
	glPopAttrib();
	expect(glIsEnabled(GL_FRAMEBUFFER_SRGB), "a switch of the colour buffer");
	shades();
}

int main(void)
{
	static void (*const frames[])(void) = {
		shades, blends, pixels, lit_and_textured, through_srgb, through_plain, through_floats, pushed,
	};
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 1, GLX_FRAMEBUFFER_SRGB_CAPABLE_ARB, 1, None };

	window_kind = "one that can hold sRGB";
	open_window_of(attributes);
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), before);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
