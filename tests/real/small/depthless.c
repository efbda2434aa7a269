/*
 * Windows whose depth is never cleared, showing pictures of framebuffer objects. One frame each; recorded by
 * test_small.py.
 */
#include "tests/trace/window.h"

static GLuint object;

static void make_object(void)
{
	GLuint texture, buffer;

	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 32, 24, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glGenFramebuffers(1, &object);
	glBindFramebuffer(GL_FRAMEBUFFER, object);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
	glGenRenderbuffers(1, &buffer);
	glBindRenderbuffer(GL_RENDERBUFFER, buffer);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, 32, 24);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffer);
}

static void quad(float x, float y, float size)
{
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		const float right = i == 1 || i == 2, up = i > 1;

		glTexCoord2f(right, up);
		glVertex2f(x + right * size, y + up * size);
	}
	glEnd();
}

static void draw_object(GLbitfield buffers)
{
	glBindFramebuffer(GL_FRAMEBUFFER, object);
	glViewport(0, 0, 32, 24);
	glClearColor(0, 0.6f, 0.3f, 1);
	glClear(buffers);
	glColor3f(0.9f, 0.5f, 0.1f);
	quad(-0.8f, -0.8f, 0.9f);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glViewport(0, 0, 64, 48);
	glClearColor(0.1f, 0.1f, 0.2f, 1);
	glClear(GL_COLOR_BUFFER_BIT);
}

static void show_object(void)
{
	glColor3f(1, 1, 1);
	glEnable(GL_TEXTURE_2D);
	quad(-0.5f, -0.5f, 1);
	glDisable(GL_TEXTURE_2D);
}

static void picture(void)
{
	draw_object(GL_COLOR_BUFFER_BIT);
	show_object();
}

static void over_a_quad(void)
{
	draw_object(GL_COLOR_BUFFER_BIT);
	glColor3f(0.2f, 0.4f, 0.9f);
	quad(-0.9f, -0.9f, 1.6f);
	show_object();
}

static void with_depth(void)
{
	draw_object(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	show_object();
}

int main(void)
{
	static void (*const frames[])(void) = { picture, over_a_quad, with_depth };

	open_window();
	make_object();
	for (size_t i = 0; i < sizeof(frames) / sizeof(*frames); i++) {
		frames[i]();
		end_frame();
	}
	return 0;
}
