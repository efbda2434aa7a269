/*
 * Copies of parts of framebuffer objects: across their edges, of depth, of colours without alpha; and many small copies
 * from a large object, whose time must depend on the copied area. One frame each; recorded by test_small.py.
 */
#include "tests/trace/window.h"

static GLuint colors, depths, copy;

/* A framebuffer object that was never drawn to: its textures keep their initial contents. */
static void use_target(GLint format, int width, int height)
{
	static GLubyte texels[64 * 48][4];
	static float depth[64 * 48];
	GLuint framebuffer;

	for (int i = 0; i < 64 * 48; i++) {
		depth[i] = (float)(i % 97) / 97;
		for (int k = 0; k < 4; k++)
			texels[i][k] = (GLubyte)(i * 7 + k * 50 + i / 64 * 11);
	}
	glGenTextures(1, &colors);
	glBindTexture(GL_TEXTURE_2D, colors);
	glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, width == 64 ? texels : NULL);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glGenTextures(1, &depths);
	glBindTexture(GL_TEXTURE_2D, depths);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, width, height, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
	             width == 64 ? depth : NULL);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glGenFramebuffers(1, &framebuffer);
	glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
	glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colors, 0);
	glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depths, 0);
	glReadBuffer(GL_COLOR_ATTACHMENT0);
	glGenTextures(1, &copy);
	glBindTexture(GL_TEXTURE_2D, copy);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static void show(void)
{
	glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
	glEnable(GL_TEXTURE_2D);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		const float s = i == 1 || i == 2, t = i >= 2;

		glTexCoord2f(s, t);
		glVertex2f(1.8f * s - 0.9f, 1.8f * t - 0.9f);
	}
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

static void before(void)
{
	glDisable(GL_BLEND);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static void parts(void)
{
	static const GLubyte gray[32 * 32] = { 0 };

	use_target(GL_RGBA, 64, 48);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 32, 32, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, gray);
	glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 10, 20, 16, 16);
	glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 16, 0, -5, -3, 16, 16);
	glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 8, 16, 55, 40, 16, 16);
	show();
}

static void without_alpha(void)
{
	use_target(GL_RGB, 64, 48);
	glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 30, 10, 16, 16, 0);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ZERO);
	show();
}

static void depths_of_it(void)
{
	use_target(GL_RGBA, 64, 48);
	glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, 3, 5, 32, 16, 0);
	show();
}

static void many_of_a_large_one(void)
{
	use_target(GL_RGB, 4096, 4096);
	for (int i = 0; i < 2000; i++)
		glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2 * i, i, 16, 16, 0);
	show();
}

int main(void)
{
	static void (*const frames[])(void) = { parts, without_alpha, depths_of_it, many_of_a_large_one };

	open_window();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), before);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
