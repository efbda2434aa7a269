/*
 * Vertex array objects, one aspect per frame: each keeps its arrays, their enabled flags and its element buffer from
 * the first frame to the last, whatever happens to the others and to the default object. Recorded by test_objects.py.
 */
#include "tests/trace/window.h"

static const float square[] = { 4, 4, 1, 0, 0, 28, 4, 0, 1, 0, 28, 28, 0, 0, 1, 4, 28, 1, 1, 0 }; /* x y r g b */
static const float triangle[] = { 34, 10, 60, 10, 47, 40 };
static const unsigned short corners[] = { 0, 1, 2, 3 }, turned[] = { 2, 1, 0 };

static unsigned objects[2], buffers[4];

static void make_objects(void)
{
	glGenVertexArrays(2, objects);
	glGenBuffers(4, buffers);
	glBindVertexArray(objects[0]);
	glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
	glBufferData(GL_ARRAY_BUFFER, sizeof(square), square, GL_STATIC_DRAW);
	glVertexPointer(2, GL_FLOAT, 20, (void *)0);
	glColorPointer(3, GL_FLOAT, 20, (void *)8);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof(corners), corners, GL_STATIC_DRAW);
	glBindVertexArray(objects[1]);
	glBindBuffer(GL_ARRAY_BUFFER, buffers[2]);
	glBufferData(GL_ARRAY_BUFFER, sizeof(triangle), triangle, GL_STATIC_DRAW);
	glVertexPointer(2, GL_FLOAT, 0, (void *)0);
	glEnableClientState(GL_VERTEX_ARRAY);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[3]);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof(turned), turned, GL_STATIC_DRAW);
	glBindVertexArray(0);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
}

static void draw(unsigned object)
{
	glBindVertexArray(object);
	if (object == objects[0])
		glDrawElements(GL_QUADS, 4, GL_UNSIGNED_SHORT, NULL);
	else
		glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, NULL);
}

static void both(void)
{
	glColor3f(1, 1, 1);
	draw(objects[0]);
	glColor3f(0.4f, 1, 0.8f);
	draw(objects[1]); /* has no colour array */
}

/* Default object, with arrays in client memory. */
static void own(void)
{
	static const float line[] = { 2, 40, 62, 44 };

	glVertexPointer(2, GL_FLOAT, 0, line);
	glEnableClientState(GL_VERTEX_ARRAY);
	glColor3f(1, 0.8f, 0.2f);
	glDrawArrays(GL_LINES, 0, 2);
	draw(objects[0]);
	glBindVertexArray(0);
	glTranslatef(0, -6, 0);
	glColor3f(1, 0.2f, 0.8f);
	glDrawArrays(GL_LINES, 0, 2);
	glDisableClientState(GL_VERTEX_ARRAY);
}

static void without_colors(void)
{
	glBindVertexArray(objects[0]);
	glDisableClientState(GL_COLOR_ARRAY);
	glColor3f(0.2f, 0.6f, 1);
	draw(objects[0]);
}

/* Deleting the bound object leaves the default one bound. */
static void deleted(void)
{
	glBindVertexArray(objects[1]);
	glDeleteVertexArrays(1, &objects[1]);
	glColor3f(1, 1, 1);
	glDrawArrays(GL_TRIANGLES, 0, 3);
	draw(objects[0]);
}

int main(void)
{
	static void (*const frames[])(void) = { both, own, both, without_colors, both, deleted };

	open_window();
	glMatrixMode(GL_PROJECTION);
	glOrtho(0, 64, 0, 48, -10, 10);
	glMatrixMode(GL_MODELVIEW);
	make_objects();
	for (unsigned i = 0; i < sizeof(frames) / sizeof(frames[0]); i++) {
		glLoadIdentity();
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		frames[i]();
		glBindVertexArray(0);
		end_frame();
	}
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
