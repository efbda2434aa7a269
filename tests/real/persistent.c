/*
 * Buffers that stay mapped while they are drawn from (ARB_buffer_storage): vertices, indices and pixels are written
 * between draws, in small and in large buffers, after few and after many unchanged frames, with and without explicit
 * flushes, and finally the buffer is deleted while mapped. The replayed pictures must equal the program's. Exits with
 * 77 if GL lacks the extension.
 */
#include "tests/trace/window.h"

enum { FRAMES = 24, CELLS = 2000 /* 16 vertices each, filling many pages */, SMALL = 64 };

struct corner {
	float position[2];
	unsigned char color[4];
};

static const unsigned persistent = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT, coherent = GL_MAP_COHERENT_BIT;

/* Create a buffer, bind it to the target and map it. */
static void *map_new(unsigned target, unsigned *name, long bytes, const void *data, unsigned access)
{
	void *mapped;

	glGenBuffers(1, name);
	glBindBuffer(target, *name);
	glBufferStorage(target, bytes, data, access & (unsigned)~GL_MAP_FLUSH_EXPLICIT_BIT);
	mapped = glMapBufferRange(target, 0, bytes, access);
	expect(mapped != NULL, "the buffer can be mapped");
	return mapped;
}

static void store(struct corner *c, float x, float y, int seed)
{
	c->position[0] = x;
	c->position[1] = y;
	for (int k = 0; k < 4; k++)
		c->color[k] = (unsigned char)(seed * (37 + 20 * k));
}

static void store_cell(struct corner *corners, int cell, int seed)
{
	float x = (float)(cell % 50) / 25 - 1, y = (float)(cell / 50) / 20 - 1, size = 0.04f;

	store(corners + 4 * cell, x, y, seed + cell);
	store(corners + 4 * cell + 1, x + size, y, seed + cell);
	store(corners + 4 * cell + 2, x + size, y + size, seed + cell);
	store(corners + 4 * cell + 3, x, y + size, seed + cell);
}

static void point_at(unsigned buffer)
{
	glBindBuffer(GL_ARRAY_BUFFER, buffer);
	glVertexPointer(2, GL_FLOAT, sizeof(struct corner), NULL);
	glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(struct corner), (void *)sizeof(float[2]));
}

/* A different triangle in each of three draws, one of them with glArrayElement. */
static void draw_small(struct corner *corners, unsigned buffer, int frame)
{
	point_at(buffer);
	for (int draw = 0; draw < 3; draw++) {
		float x = 0.5f * (float)draw - 0.8f + 0.01f * (float)frame;

		store(corners, x, -0.5f, frame + draw);
		store(corners + 1, x + 0.4f, -0.5f, frame + 3 * draw);
		store(corners + 2, x, 0.5f, frame + 7 * draw);
		if (draw < 2) {
			glDrawArrays(GL_TRIANGLES, 0, 3);
			continue;
		}
		glBegin(GL_TRIANGLES);
		for (int i = 0; i < 3; i++)
			glArrayElement(i);
		glEnd();
	}
}

static void draw_textured(unsigned char *pixels, int frame)
{
	for (int i = 0; i < 8 * 8 * 4; i++)
		pixels[i] = (unsigned char)(i * 3 + frame * 31);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glEnable(GL_TEXTURE_2D);
	glColor3f(1, 1, 1);
	glBegin(GL_TRIANGLES);
	glTexCoord2f(0, 0);
	glVertex2f(0.2f, -1);
	glTexCoord2f(1, 0);
	glVertex2f(1, -1);
	glTexCoord2f(0, 1);
	glVertex2f(0.2f, -0.2f);
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

int main(void)
{
	struct corner *large, *small, *flushed;
	unsigned short *order;
	unsigned char *pixels;
	unsigned names[5];

	open_window();
	if (!strstr((const char *)glGetString(GL_EXTENSIONS), "GL_ARB_buffer_storage"))
		return 77;
	large = map_new(GL_ARRAY_BUFFER, &names[0], CELLS * 4 * (long)sizeof(*large), NULL, persistent | coherent);
	small = map_new(GL_ARRAY_BUFFER, &names[1], SMALL * (long)sizeof(*small), NULL, persistent | coherent);
	flushed = map_new(GL_ARRAY_BUFFER, &names[2], SMALL * (long)sizeof(*small), NULL,
	                  persistent | GL_MAP_FLUSH_EXPLICIT_BIT);
	order = map_new(GL_ELEMENT_ARRAY_BUFFER, &names[3], CELLS * 4 * (long)sizeof(*order), NULL, persistent | coherent);
	pixels = map_new(GL_PIXEL_UNPACK_BUFFER, &names[4], 8 * 8 * 4, NULL, persistent | coherent);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	for (int i = 0; i < CELLS; i++)
		store_cell(large, i, 0);
	for (int i = 0; i < CELLS * 4; i++)
		order[i] = (unsigned short)i;
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	for (int frame = 0; frame < FRAMES; frame++) {
		glClear(GL_COLOR_BUFFER_BIT);
		if (frame == 10 || frame == 18 || frame == 19)
			for (int i = 0; i < 40; i++)
				store_cell(large, 700 + 13 * i, frame);
		if (frame == 14)
			for (int i = 0; i < 400; i++)
				order[3000 + i] = (unsigned short)(7000 - i);
		point_at(names[0]);
		glDrawElements(GL_QUADS, CELLS * 4, GL_UNSIGNED_SHORT, NULL);
		draw_small(small, names[1], frame);
		for (int i = 0; i < 3; i++)
			store(flushed + i, i == 1 ? 0.9f : 0.5f, i == 2 ? 0.9f : 0.6f, frame + i);
		glBindBuffer(GL_ARRAY_BUFFER, names[2]);
		glFlushMappedBufferRange(GL_ARRAY_BUFFER, 0, 3 * sizeof(*flushed));
		point_at(names[2]);
		glDrawArrays(GL_TRIANGLES, 0, 3);
		draw_textured(pixels, frame);
		if (frame == 20) { /* the last contents of a mapping remain after it has ended */
			store_cell(large, 1000, 3);
			glBindBuffer(GL_ARRAY_BUFFER, names[0]);
			glUnmapBuffer(GL_ARRAY_BUFFER);
		}
		expect(glGetError() == GL_NO_ERROR, "no error");
		end_frame();
	}
	glDeleteBuffers(5, names);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
