/*
 * Deep blending: pixels under far more fragments than a camera kernel collects at once, most of them slices of a 3D
 * texture. Recorded by test_deep.py. With a number N as argument: N frames of 256 slices that fill 512 x 512 pixels,
 * for show-reach.
 */
#include "tests/trace/window.h"

#define SIZE 16
#define BIG 64
#define SLICES 60

static void make_volume(GLsizei n, GLint filter, GLint wrap)
{
	static GLubyte texels[BIG * BIG * BIG][4];

	srand(1);
	for (size_t i = 0; i < sizeof(texels); i++)
		texels[i / 4][i % 4] = (GLubyte)(rand() >> 8 & (i % 4 == 3 ? 31 : 255));
	glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA8, n, n > SIZE ? n : SIZE, n, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, filter);
	glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, filter);
	for (GLenum axis = 0; axis < 3; axis++)
		glTexParameteri(GL_TEXTURE_3D, axis == 2 ? GL_TEXTURE_WRAP_R : GL_TEXTURE_WRAP_S + axis, wrap);
	glEnable(GL_TEXTURE_3D);
}

static void slice(float z)
{
	for (int i = 0; i < 4; i++) {
		const float x = i == 1 || i == 2, y = i > 1;

		glTexCoord3f(1.5f * x - 0.25f, 1.5f * y - 0.25f, 1.5f * z - 0.25f);
		glVertex3f(1.6f * x - 0.8f, 1.6f * y - 0.8f, 1.6f * z - 0.8f);
	}
}

/* Slices of a cube, slightly rotated and in perspective. */
static void slices(int backwards, int at_once)
{
	glPushMatrix();
	glFrustum(-0.5, 0.5, -0.5, 0.5, 1, 9);
	glTranslatef(0, 0, -2.6f);
	glRotatef(20, 1, 2, 0);
	if (at_once)
		glBegin(GL_QUADS);
	for (int i = 0; i < SLICES; i++) {
		if (!at_once)
			glBegin(GL_QUADS);
		slice(((backwards ? SLICES - 1 - i : i) + 0.5f) / SLICES);
		if (!at_once)
			glEnd();
	}
	if (at_once)
		glEnd();
	glPopMatrix();
}

/* More triangles than a tile lists at once, some of them lines. */
static void heap(void)
{
	glDisable(GL_TEXTURE_3D);
	srand(2);
	for (int part = 0; part < 3; part++) {
		glBegin(part == 1 ? GL_LINES : GL_TRIANGLES);
		for (int i = 0; i < 900; i++) {
			glColor4f((float)(rand() & 15) / 15, (float)(rand() & 15) / 15, (float)part / 2, 0.1f);
			glVertex3f((float)(rand() & 255) / 128 - 1, (float)(rand() & 255) / 128 - 1, (float)(rand() & 255) / 128 - 1);
		}
		glEnd();
	}
	glColor4f(1, 1, 1, 1);
}

static void show_full(int frames)
{
	window_size[0] = window_size[1] = 512;
	open_window();
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	make_volume(BIG, GL_LINEAR, GL_REPEAT);
	glScalef(1.25f, 1.25f, 1);
	for (int frame = 0; frame < frames; frame++) {
		glClear(GL_COLOR_BUFFER_BIT);
		for (int i = 0; i < 256; i++) {
			glBegin(GL_QUADS);
			slice(((float)i + 0.5f) / 256);
			glEnd();
		}
		end_frame();
	}
	glFinish();
}

int main(int argc, char **argv)
{
	if (argc > 1) {
		show_full(atoi(argv[1]));
		return 0;
	}
	open_window();
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (int frame = 0; frame < 6; frame++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		make_volume(frame == 2 ? 12 : SIZE, frame == 4 ? GL_NEAREST : GL_LINEAR, frame == 3 ? GL_CLAMP_TO_EDGE : GL_REPEAT);
		if (frame == 5)
			heap();
		else
			slices(frame & 1, frame > 1);
		end_frame();
	}
	return 0;
}
