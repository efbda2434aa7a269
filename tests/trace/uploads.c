/*
 * Textures and pixel rectangles that are uploaded repeatedly: two alternating pictures, and a part of one of them under
 * other unpack state. The replayed recording must show the program's pictures and store each content at most twice. Run
 * by tests/real/test_record_uploads.sh.
 */
#include "window.h"

enum { FRAMES = 40, SIDE = 64 };

static unsigned char pictures[2][SIDE][SIDE][4];

int main(void)
{
	unsigned seed = 1, texture;

	open_window();
	for (unsigned char *p = &pictures[0][0][0][0]; p < &pictures[0][0][0][0] + sizeof(pictures); p++)
		*p = (unsigned char)((seed = seed * 1664525u + 1013904223u) >> 24); /* incompressible */
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	for (int frame = 0; frame < FRAMES; frame++) {
		glClear(GL_COLOR_BUFFER_BIT);
		if (frame % 8 == 0)
			glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, pictures[frame % 16 == 0]);
		else
			glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, pictures[frame % 2]);
		glEnable(GL_TEXTURE_2D);
		glBegin(GL_QUADS);
		for (int i = 0; i < 4; i++) {
			glTexCoord2i(i == 1 || i == 2, i / 2);
			glVertex2f(i == 1 || i == 2 ? 1.0f : -1.0f, i / 2 ? 1.0f : -1.0f);
		}
		glEnd();
		glDisable(GL_TEXTURE_2D);
		glPixelStorei(GL_UNPACK_ROW_LENGTH, SIDE);
		glPixelStorei(GL_UNPACK_SKIP_PIXELS, frame % 4);
		glPixelStorei(GL_UNPACK_SKIP_ROWS, frame % 3);
		glRasterPos2f(-0.5f, -0.5f);
		glDrawPixels(16, 16, GL_RGBA, GL_UNSIGNED_BYTE, pictures[1]);
		glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
		glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
		glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
		if (frame == FRAMES / 2)
			pictures[1][9][9][0] ^= 255;
		expect(glGetError() == GL_NO_ERROR, "no error");
		end_frame();
	}
	return 0;
}
