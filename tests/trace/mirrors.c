/*
 * Client arrays that change in every way between draws, for twenty frames; the replayed recording must show the
 * program's pictures. Run by tests/real/test_record_arrays.sh; makes the same draws in each frame with other data.
 */
#include <sys/mman.h>

#include "window.h"

enum { FRAMES = 20, CELLS = 400, CORNERS = 6 * CELLS };

struct corner {
	float position[2];
	unsigned char color[4];
};

static struct corner corners[CORNERS];
static float positions[CORNERS][2], colors[CORNERS][3];
static unsigned short order[CORNERS];

/* Two triangles in cell i of a grid of 20 x 20 cells. */
static void place(float p[2], int i)
{
	static const float at[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 0, 1 } };
	int cell = i / 6;

	p[0] = ((float)(cell % 20) + at[i % 6][0]) / 10 - 1;
	p[1] = ((float)(cell / 20) + at[i % 6][1]) / 10 - 1;
}

static void shade(float c[3], int i, int seed)
{
	for (int k = 0; k < 3; k++)
		c[k] = (float)((i / 6 * 37 + seed * 101 + k * 59) % 256) / 255;
}

/* Members of a struct; a few change, different ones each time. */
static void draw_structs(int frame)
{
	for (int i = 0; i < CORNERS; i++) {
		place(corners[i].position, i);
		if (frame == 0 || i / 60 == frame)
			for (int k = 0; k < 4; k++)
				corners[i].color[k] = (unsigned char)(i + 60 * k + frame);
	}
	glVertexPointer(2, GL_FLOAT, sizeof(corners[0]), corners[0].position);
	glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(corners[0]), corners[0].color);
	glDrawArrays(GL_TRIANGLES, 600, 600);
	glDrawArrays(GL_TRIANGLES, 300 + 6 * frame, 120); /* overlaps the known range from below */
}

/* Growing ranges, changing indices, and alternating contents at one address. */
static void draw_elements(int frame)
{
	int base = 1200;

	for (int i = 0; i < CORNERS; i++) {
		place(positions[i], i);
		shade(colors[i], i, frame % 3);
		order[i] = (unsigned short)i;
	}
	glVertexPointer(2, GL_FLOAT, 0, positions);
	glColorPointer(3, GL_FLOAT, 0, colors);
	for (int n = 0; n < 8; n++) {
		if (n == 4)
			for (int i = 0; i < 150; i++)
				order[base + n * 150 + i] = (unsigned short)(base + n * 150 + 149 - i + frame % 2 * 3);
		if (n == 6)
			shade(colors[base + n * 150], frame, frame); /* between two draws of one frame */
		glDrawElements(GL_TRIANGLES, 150, GL_UNSIGNED_SHORT, order + base + n * 150);
	}
}

/* Another array at the address of an unmapped one. */
static void draw_remapped(int frame)
{
	const size_t bytes = 16384;
	float(*p)[2] = mmap((void *)0x100000000, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);

	expect(p != MAP_FAILED, "pages");
	for (int i = 0; i < 300; i++)
		place(p[i], i + frame * 6 % 60);
	glDisableClientState(GL_COLOR_ARRAY);
	glColor3f(0, (float)frame / FRAMES, 1);
	glVertexPointer(2, GL_FLOAT, 0, p);
	glDrawArrays(GL_TRIANGLES, 0, frame % 2 ? 300 : 120);
	glEnableClientState(GL_COLOR_ARRAY);
	munmap(p, bytes);
}

int main(void)
{
	open_window();
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	for (int frame = 0; frame < FRAMES; frame++) {
		glClear(GL_COLOR_BUFFER_BIT);
		draw_structs(frame);
		draw_elements(frame);
		draw_remapped(frame);
		expect(glGetError() == GL_NO_ERROR, "no error");
		end_frame();
	}
	return 0;
}
