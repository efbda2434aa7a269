/*
 * Ten frames, each based on objects, state and pixels of earlier ones; the pictures are the same in every run. The
 * window is not cleared after the first frame, unless an argument is given. For recordings that start in the middle.
 */
#include "window.h"

enum { FRAMES = 10 };

static unsigned copied, drawn_to, list, framebuffer;

static void square(float x, float y, float size)
{
	glTexCoord2f(0, 0);
	glVertex2f(x, y);
	glTexCoord2f(1, 0);
	glVertex2f(x + size, y);
	glTexCoord2f(1, 1);
	glVertex2f(x + size, y + size);
	glTexCoord2f(0, 1);
	glVertex2f(x, y + size);
}

static void textured_square(unsigned texture, float x, float y)
{
	glEnable(GL_TEXTURE_2D);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	glBegin(GL_QUADS);
	square(x, y, 0.5f);
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

static unsigned make_texture(int copy)
{
	unsigned texture;

	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	if (copy)
		glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 16, 16, 0);
	else
		glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	return texture;
}

/* Objects that later frames need. */
static void make_objects(void)
{
	glClearColor(0.1f, 0.2f, 0.3f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	copied = make_texture(1);
	drawn_to = make_texture(0);
	glGenFramebuffers(1, &framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, drawn_to, 0);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	list = glGenLists(1);
	glNewList(list, GL_COMPILE_AND_EXECUTE);
	glColor3f(0.9f, 0.5f, 0);
	glRectf(-0.2f, -0.2f, 0, 0);
	glEndList();
}

static void draw_to_texture(int frame)
{
	glPushAttrib(GL_VIEWPORT_BIT | GL_COLOR_BUFFER_BIT);
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	glViewport(0, 0, 16, 16);
	glClearColor(0, 0.1f * (float)frame, 0.5f, 1);
	glClear(GL_COLOR_BUFFER_BIT);
	glRectf(-0.5f, -0.5f, 0.5f, 0.5f); /* in the colour left by the previous frame */
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glPopAttrib();
}

static void draw(int frame)
{
	static float corners[] = { 0, 0, 0.3f, 0, 0, 0.3f };
	float at = -1 + 0.15f * (float)frame;

	if (frame % 4 == 1)
		draw_to_texture(frame);
	glCallList(list);
	textured_square(copied, -1, 0.4f);
	textured_square(drawn_to, 0.4f, 0.4f);
	glEnable(GL_DEPTH_TEST);
	glBegin(GL_TRIANGLES); /* a little nearer in each frame, over the existing picture */
	glColor3f(0.2f, 0.1f * (float)frame, 0.8f);
	glVertex3f(at, -0.9f, 0.9f - 0.05f * (float)frame);
	glVertex3f(at + 0.4f, -0.9f, 0.1f);
	glColor3f(1, 0.2f, 0.1f * (float)frame); /* the next frame starts with the last colour */
	glVertex3f(at, -0.3f, 0);
	glEnd();
	glDisable(GL_DEPTH_TEST);
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_FLOAT, 0, corners);
	corners[4] = 0.02f * (float)frame;
	glDrawArrays(GL_TRIANGLES, 0, 3);
	glDisableClientState(GL_VERTEX_ARRAY);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, frame); /* left set for the next frame */
	glEnable(GL_SCISSOR_TEST);                  /* also left set */
	glScissor(0, 0, 64, 40 + frame % 8);
	if (frame % 3 == 0) {
		glBindTexture(GL_TEXTURE_2D, copied);
		glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 4 * frame, 4, 16, 16);
	}
}

int main(int argc, char **argv)
{
	(void)argv;
	open_window();
	for (int frame = 0; frame < FRAMES; frame++) {
		if (frame == 0)
			make_objects();
		if (argc > 1) {
			glDisable(GL_SCISSOR_TEST);
			glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		}
		draw(frame);
		end_frame();
	}
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
