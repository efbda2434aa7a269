/*
 * Persistent mappings that end without an unmap: of deleted buffers, of as many as can be tracked at once, and of a
 * destroyed context. Stores to a later mapping must be recorded. A read-only mapping is not tracked. Exits with 77 if
 * GL has no persistent mappings.
 */
#include "window.h"

enum { MANY = 256, FLOATS = 1 << 18 };

static float *map_new(unsigned *name, long bytes, unsigned access)
{
	float *mapped;

	access |= GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
	glGenBuffers(1, name);
	glBindBuffer(GL_ARRAY_BUFFER, *name);
	glBufferStorage(GL_ARRAY_BUFFER, bytes, NULL, access);
	mapped = glMapBufferRange(GL_ARRAY_BUFFER, 0, bytes, access);
	expect(mapped != NULL, "the buffer can be mapped");
	return mapped;
}

static void map_in_another_context(void)
{
	GLXContext first = glXGetCurrentContext(), second;
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 1, GLX_STENCIL_SIZE, 1, None };
	unsigned name;

	second = glXCreateContext(display, glXChooseVisual(display, DefaultScreen(display), attributes), NULL, True);
	expect(glXMakeCurrent(display, window, second), "a second context");
	map_new(&name, 64, GL_MAP_WRITE_BIT);
	glXMakeCurrent(display, window, first);
	glXDestroyContext(display, second);
}

int main(void)
{
	unsigned names[MANY], name;
	float *mapped;

	open_window();
	if (!strstr((const char *)glGetString(GL_EXTENSIONS), "GL_ARB_buffer_storage"))
		return 77;
	for (int i = 0; i < MANY; i++)
		map_new(&names[i], 64, GL_MAP_WRITE_BIT);
	glDeleteBuffers(MANY, names);
	map_in_another_context();
	glColor3f(1, 0, 0);
	map_new(&name, 64, GL_MAP_READ_BIT);
	glUnmapBuffer(GL_ARRAY_BUFFER);
	mapped = map_new(&name, FLOATS * (long)sizeof(float), GL_MAP_WRITE_BIT);
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_FLOAT, 0, NULL);
	mapped[2] = mapped[5] = 1;
	glDrawArrays(GL_TRIANGLES, 0, 3);
	expect(glGetError() == GL_NO_ERROR, "no error");
	end_frame();
	return 0;
}
