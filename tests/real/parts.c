/*
 * Frames that depend on no earlier one although no clear covers the whole window, or a texture is copied in parts: two
 * views with a clear each; a corner copied to a texture before the rest is cleared; a texture larger than the copied
 * region; opaque squares that cover the window, some with blending. The last three frames do depend on earlier ones.
 * Recorded by test_parts.py.
 */
#include "tests/trace/window.h"

#define SIZE 96

static void square(float x0, float y0, float x1, float y1, float z)
{
	glBegin(GL_QUADS);
	glTexCoord2f(0, 0);
	glVertex3f(x0, y0, z);
	glTexCoord2f(0.75f, 0);
	glVertex3f(x1, y0, z);
	glTexCoord2f(0.75f, 0.75f);
	glVertex3f(x1, y1, z);
	glTexCoord2f(0, 0.75f);
	glVertex3f(x0, y1, z);
	glEnd();
}

static void clear_part(int x, int y, int width, int height, float red)
{
	glScissor(x, y, width, height);
	glViewport(x, y, width, height);
	glClearColor(red, 0.3f, 0.4f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static void two_views(int frame, int width)
{
	glEnable(GL_SCISSOR_TEST);
	for (int i = 0; i < 2; i++) {
		clear_part(i * SIZE / 2, 0, i ? width : SIZE / 2, SIZE, 0.5f * (float)i);
		glColor3f(1, 0.1f * (float)frame, 0);
		square(-0.6f, -0.6f, 0.5f, 0.5f, 0.3f);
		glColor3f(0, 0.1f * (float)frame, 1);
		square(-0.2f, -0.2f, 0.8f, 0.8f, i ? 0.5f : 0.1f);
	}
	glDisable(GL_SCISSOR_TEST);
	glViewport(0, 0, SIZE, SIZE);
}

/* Draw the window's lower left 48 x 48 pixels, copy them to three quarters of a texture, then show it. */
static void corner(int frame, int copied)
{
	glEnable(GL_SCISSOR_TEST);
	clear_part(0, 0, 48, 48, 0.2f);
	glColor3f(0.1f * (float)frame, 1, 0);
	square(-0.5f, -0.7f, 0.3f, 0.9f, 0);
	if (copied)
		glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, copied, copied);
	glDisable(GL_SCISSOR_TEST);
	glViewport(0, 0, SIZE, SIZE);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_TEXTURE_2D);
	glColor3f(1, 1, 1);
	square(-0.9f, -0.9f, 0.7f, 0.8f, 0);
	glDisable(GL_TEXTURE_2D);
}

/* Opaque tiles, or blended ones of lower alpha */
static void tiles(int frame, float alpha)
{
	glClear(GL_DEPTH_BUFFER_BIT);
	glDisable(GL_DEPTH_TEST);
	for (int i = 0; i < 16; i++) {
		float x = (float)(i % 4) / 2 - 1, y = (float)(i / 4) / 2 - 1;

		glColor4f((float)i / 16, 0.1f * (float)frame, 0.6f, alpha);
		square(x, y, x + 0.5f, y + 0.5f, 0);
	}
	glEnable(GL_DEPTH_TEST);
}

static void blended_tiles(int frame, float alpha)
{
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	tiles(frame, alpha);
	glDisable(GL_BLEND);
}

int main(void)
{
	static const unsigned char grey[64 * 64 * 3];

	window_size[0] = window_size[1] = SIZE;
	open_window();
	glEnable(GL_DEPTH_TEST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 64, 64, 0, GL_RGB, GL_UNSIGNED_BYTE, grey);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	for (int frame = 0; frame < 11; frame++) {
		if (frame < 2)
			two_views(frame, SIZE / 2);
		else if (frame < 4)
			corner(frame, 48);
		else if (frame < 6)
			tiles(frame, 1);
		else if (frame < 8)
			blended_tiles(frame, 1);
		else if (frame == 8)
			two_views(frame, SIZE / 2 - 1); /* old contents: one column */
		else if (frame == 9)
			corner(frame, 32); /* and part of the texture */
		else
			blended_tiles(frame, 0.9f); /* and a share of every pixel */
		end_frame();
	}
	return 0;
}
