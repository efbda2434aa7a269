/* A program's own reads of pixels, and frames that end without a swap. */
#include "window.h"

int main(void)
{
	static unsigned char pixels[64];
	unsigned texture, buffer;

	open_window();
	for (int frame = 0; frame < 2; frame++) {
		glClearColor(1, 0.2f, 0, 1);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glClear(GL_COLOR_BUFFER_BIT);
		glRectf(-1, -1, frame, 1);
		glPixelStorei(GL_PACK_ALIGNMENT, 4);
		glReadPixels(0, 0, 1, 2, GL_RGB, GL_UNSIGNED_BYTE, pixels); /* rows of 4: 4 + 3 */
		expect(pixels[0] == 255 && pixels[4] == 255, "white or orange");
		glReadPixels(63, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
		expect(pixels[0] == 255 && pixels[1] == (frame ? 255 : 51), "the right edge");
		glFlush();
		glFinish();
	}
	glBegin(GL_POINTS);
	glReadPixels(0, 0, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, pixels); /* an error, which ends no frame */
	glEnd();
	expect(glGetError() == GL_INVALID_OPERATION, "no reads between Begin and End");

	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2, 1, 0, GL_RGB, GL_UNSIGNED_BYTE, "abcdef");
	glGetTexImage(GL_TEXTURE_2D, 0, GL_RGB, GL_UNSIGNED_BYTE, pixels);
	expect(memcmp(pixels, "abcdef", 6) == 0, "the texture's own bytes");
	glGetTexImage(GL_TEXTURE_2D, 99, GL_RGB, GL_UNSIGNED_BYTE, pixels);
	expect(glGetError() == GL_INVALID_VALUE, "no such level");
	expect(glGetError() == GL_NO_ERROR, "one error for one mistake");
	glGenBuffers(1, &buffer);
	glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
	glBufferData(GL_PIXEL_PACK_BUFFER, 16, NULL, GL_STREAM_READ);
	glGetTexImage(GL_TEXTURE_2D, 0, GL_RGB, GL_UNSIGNED_BYTE, (void *)4);
	glGetBufferSubData(GL_PIXEL_PACK_BUFFER, 4, 6, pixels);
	expect(memcmp(pixels, "abcdef", 6) == 0, "the same through a buffer");
	return 0;
}
