/* Exactly the elements of client arrays that draws read: a single vertex, empty parts, long index lists, parameters
 * in memory. */
#include "window.h"

enum { MANY = 9000, HIGHEST = 7 };

static float places[4096][3];
static unsigned short wide[MANY];
static unsigned char narrow[MANY];
static unsigned longest[MANY];

/* The highest index is near the end. */
static void draw_many(unsigned type, const void *indices)
{
	unsigned buffer;

	glDrawElements(GL_POINTS, MANY, type, indices);
	glGenBuffers(1, &buffer);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER,
	             MANY * (type == GL_UNSIGNED_BYTE  ? 1 :
	                     type == GL_UNSIGNED_SHORT ? 2 :
	                                                 4),
	             indices, GL_STATIC_DRAW);
	glDrawElements(GL_POINTS, MANY, type, (void *)0);
	glDrawElements(GL_POINTS, MANY - 10, type,
	               (void *)(type == GL_UNSIGNED_BYTE  ? 4l :
	                        type == GL_UNSIGNED_SHORT ? 8l :
	                                                    16l));
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
}

int main(void)
{
	static const unsigned few[3] = { 0, 1, 5 }, parameters[5] = { 3, 1, 0, 0, 0 };
	unsigned buffer;

	open_window();
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(3, GL_FLOAT, 0, places);
	glDrawArrays(GL_POINTS, 0, 1);
	glDrawArrays(GL_POINTS, 5, 1);
	glDrawArrays(GL_POINTS, 3000, 0);
	glMultiDrawArrays(GL_POINTS, (const int[]){ 2, 3000, 1 }, (const int[]){ 2, 0, 1 }, 3);
	for (int i = 0; i < MANY; i++) {
		wide[i] = (unsigned short)(i == MANY - 100 ? HIGHEST : i % 3);
		narrow[i] = (unsigned char)wide[i];
		longest[i] = wide[i];
	}
	draw_many(GL_UNSIGNED_BYTE, narrow);
	draw_many(GL_UNSIGNED_SHORT, wide);
	draw_many(GL_UNSIGNED_INT, longest);

	glGenBuffers(1, &buffer);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof(few), few, GL_STATIC_DRAW);
	glDrawElementsIndirect(GL_POINTS, GL_UNSIGNED_INT, parameters);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
	glDrawArraysIndirect(GL_POINTS, (const unsigned[]){ 4, 1, 2, 0 });
	expect(glGetError() == GL_NO_ERROR, "no error");
	end_frame();
	return 0;
}
