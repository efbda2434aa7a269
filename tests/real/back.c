/*
 * 240 frames, each adding a stripe to the window. Every 20th frame clears it, but none after frame 140 does. A noise
 * texture per frame enlarges the recording, so that it has checkpoints. Recorded by test_back.py.
 */
#include <stdint.h>

#include "tests/trace/window.h"

enum { FRAMES = 240, OFTEN = 20, LAST = 140, WIDTH = 128, HEIGHT = 64 };

static void make_noise(void)
{
	static uint32_t texels[WIDTH * HEIGHT], last = 1;

	for (int i = 0; i < WIDTH * HEIGHT; i++)
		texels[i] = last = last * 1664525u + 1013904223u;
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, WIDTH, HEIGHT, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

static void draw(int frame)
{
	const float x = -0.95f + (frame < LAST ? 1.9f * (float)(frame % OFTEN) / OFTEN : 0.019f * (float)(frame - LAST));

	if (frame % OFTEN == 0 && frame <= LAST)
		glClear(GL_COLOR_BUFFER_BIT);
	make_noise();
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		const float right = i == 1 || i == 2, up = i > 1;

		glTexCoord2f(right, up);
		glVertex2f(x + 0.03f * right, -0.9f + up * (1.3f + 0.01f * (float)(frame % 40)));
	}
	glEnd();
}

int main(void)
{
	open_window();
	glClearColor(0.1f, 0.2f, 0.4f, 1);
	glEnable(GL_TEXTURE_2D);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	for (int frame = 0; frame < FRAMES; frame++) {
		draw(frame);
		end_frame();
	}
	return 0;
}
