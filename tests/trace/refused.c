/* Calls that GL refuses may have invalid pointers: the recorder must not read there. */
#include "window.h"

#include <limits.h>
#include <sys/mman.h>

#define PAGE 4096
#define RESERVED (8 << 20) /* bytes */

/* Unmapped arrays of a few values and of more than memory holds; the last one has only its first values. */
static void pass_arrays(void)
{
	const float *nowhere = (const float *)8;
	char *pages = mmap(NULL, RESERVED, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
	const unsigned short *end = (const unsigned short *)(pages + PAGE) - 2;

	expect(pages != MAP_FAILED && mprotect(pages, PAGE, PROT_READ | PROT_WRITE) == 0,
	       "one readable page, and none after it");
	memset(pages, 7, PAGE);
	glPixelMapfv(GL_PIXEL_MAP_R_TO_R, 1 << 30, nowhere);
	expect(glGetError() == GL_INVALID_VALUE, "no map is that long");
	glPixelMapfv(GL_PIXEL_MAP_R_TO_R, 1 << 20, (const float *)pages);
	expect(glGetError() == GL_INVALID_VALUE, "not even at a valid address");
	glMap2f(GL_MAP2_VERTEX_3, 0, 1, INT_MAX, INT_MAX, 0, 1, 1 << 30, 7, (const float *)pages); /* 2^64 + 20 bytes */
	expect(glGetError() == GL_INVALID_VALUE, "no map has such a high order");
	glTexImage2D(GL_TEXTURE_1D, 0, GL_RGBA, 1 << 30, 1 << 29, 0, GL_RGBA, GL_UNSIGNED_BYTE, pages);
	expect(glGetError() == GL_INVALID_ENUM, "no target for two dimensions");
	glPixelMapusv(GL_PIXEL_MAP_I_TO_R, 20, end);
	expect(glGetError() == GL_INVALID_VALUE, "20 is not a power of two");
	glUniform4fv(-1, 1, nowhere);
	expect(glGetError() == GL_INVALID_OPERATION, "no program is current");
	glUniform4fv(-1, 100, (const float *)(pages + PAGE));
	expect(glGetError() == GL_INVALID_OPERATION, "nor now");
	glBegin(GL_POINTS);
	glLoadMatrixf(nowhere);
	glEnd();
	expect(glGetError() == GL_INVALID_OPERATION, "no matrices between Begin and End");
	munmap(pages, RESERVED);
}

int main(void)
{
	const char *nowhere[1] = { (const char *)8 };

	open_window();
	glShaderSource(12345, 1, nowhere, NULL); /* there is no such shader */
	expect(glGetError() == GL_INVALID_VALUE, "no such shader");
	glShaderSource(12345, 1, (const char **)8, NULL);
	expect(glGetError() == GL_INVALID_VALUE, "nor now");
	pass_arrays();
	end_frame();
	return 0;
}
