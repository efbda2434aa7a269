/* Vertex arrays in client memory and in buffers, drawn in every way; one of them ends too early. */
#include <sys/mman.h>
#include <unistd.h>

#include "window.h"

static const float triangle[3][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 0, 1, 0 } };
static const unsigned char colors[3][4] = { { 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 } };

/*
 * An enabled array that is too short but unused: texturing is off, so GL does not read texture coordinates. Two of
 * three elements are readable.
 */
static void draw_with_short_array(void)
{
	long page = sysconf(_SC_PAGESIZE);
	char *pages = mmap(NULL, 2 * (size_t)page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);

	expect(pages != MAP_FAILED, "two pages");
	munmap(pages + page, (size_t)page);
	memset(pages + page - 16, 7, 16);
	glEnableClientState(GL_TEXTURE_COORD_ARRAY);
	glTexCoordPointer(2, GL_FLOAT, 0, pages + page - 16);
	glDrawArrays(GL_TRIANGLES, 0, 3);
	glDisableClientState(GL_TEXTURE_COORD_ARRAY);
}

int main(void)
{
	static const unsigned short indices[4] = { 2, 1, 0, 65535 };
	static const float interleaved[3][6] = { { 1, 0, 0, -1, -1, 0 }, { 0, 1, 0, 1, -1, 0 }, { 0, 0, 1, 0, 1, 0 } };
	static const int first[2] = { 0, 0 }, counts[2] = { 3, 2 };
	static const unsigned modes[3] = { GL_TRIANGLES, GL_TRIANGLE_FAN, GL_QUADS }; /* strides of 8 bytes, and of 4 */
	const void *const many[2] = { indices, indices + 1 };
	unsigned buffer;

	open_window();
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(3, GL_FLOAT, 0, triangle);
	glDrawArrays(GL_TRIANGLES, 0, 3);
	glEnableClientState(GL_COLOR_ARRAY);
	glColorPointer(4, GL_UNSIGNED_BYTE, 0, colors);
	glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, indices);
	glDrawRangeElements(GL_TRIANGLES, 0, 2, 3, GL_UNSIGNED_SHORT, indices);
	glMultiDrawArrays(GL_TRIANGLES, first, counts, 2);
	glMultiDrawElements(GL_LINES, (const GLsizei[]){ 2, 2 }, GL_UNSIGNED_SHORT, many, 2);
	((PFNGLMULTIMODEDRAWARRAYSIBMPROC)glXGetProcAddress((const GLubyte *)"glMultiModeDrawArraysIBM"))(modes, first,
	                                                                                                  counts, 2, 8);
	((PFNGLMULTIMODEDRAWELEMENTSIBMPROC)glXGetProcAddress((const GLubyte *)"glMultiModeDrawElementsIBM"))(
		modes, (const GLsizei[]){ 2, 1 }, GL_UNSIGNED_SHORT, many, 2, 4);
	glBegin(GL_TRIANGLES);
	glArrayElement(1);
	glEnd();
	draw_with_short_array();

	/* Colours from a buffer, positions from client memory. */
	glGenBuffers(1, &buffer);
	glBindBuffer(GL_ARRAY_BUFFER, buffer);
	glBufferData(GL_ARRAY_BUFFER, sizeof(colors), colors, GL_STATIC_DRAW);
	glColorPointer(4, GL_UNSIGNED_BYTE, 0, (void *)4);
	glDrawArrays(GL_POINTS, 0, 2);
	glBindBuffer(GL_ARRAY_BUFFER, 0);

	glInterleavedArrays(GL_C3F_V3F, 0, interleaved);
	glDrawArrays(GL_TRIANGLES, 0, 3);

	/* The restart index is not a vertex. */
	glEnable(GL_PRIMITIVE_RESTART);
	glPrimitiveRestartIndex(65535);
	glDrawElements(GL_LINE_STRIP, 4, GL_UNSIGNED_SHORT, indices);
	expect(glGetError() == GL_NO_ERROR, "no error");
	end_frame();
	return 0;
}
