/*
 * Indirect and unusual draws, one per frame: parameters in memory and in buffers, multiple draws, instances,
 * glArrayElement with some arrays in buffers, and NV_primitive_restart's own state. Recorded by test_record_buffers.py.
 * Exits with 77 if GL lacks one of them.
 */
#include "tests/trace/window.h"

enum { N = 24 };

static float positions[N][2], colors[N][3];
static unsigned short order[2 * N];
static unsigned array_buffer, element_buffer, indirect_buffer;

static void fill(int frame)
{
	for (int i = 0; i < N; i++) {
		positions[i][0] = (float)(i / 3 % 4) / 2 - 1 + (i % 3 == 1 ? 0.43f : 0.03f) + 0.01f * (float)frame;
		positions[i][1] = (float)(i / 12) - 0.96f + (i % 3 == 2 ? 0.87f : 0.05f);
		for (int k = 0; k < 3; k++)
			colors[i][k] = (float)((i * 37 + k * 59 + frame * 17) % 200 + 50) / 255;
	}
	for (int i = 0; i < 2 * N; i++)
		order[i] = (unsigned short)((i * 5 + frame) % N);
}

/* Positions in client memory or in the buffer, and likewise colours. */
static void point(int buffered_positions, int buffered_colors)
{
	glBindBuffer(GL_ARRAY_BUFFER, array_buffer);
	glBufferData(GL_ARRAY_BUFFER, sizeof(positions) + sizeof(colors), NULL, GL_STATIC_DRAW);
	glBufferSubData(GL_ARRAY_BUFFER, 0, sizeof(positions), positions);
	glBufferSubData(GL_ARRAY_BUFFER, sizeof(positions), sizeof(colors), colors);
	glBindBuffer(GL_ARRAY_BUFFER, buffered_positions ? array_buffer : 0);
	glVertexPointer(2, GL_FLOAT, 0, buffered_positions ? NULL : positions);
	glBindBuffer(GL_ARRAY_BUFFER, buffered_colors ? array_buffer : 0);
	glColorPointer(3, GL_FLOAT, 0, buffered_colors ? (void *)sizeof(positions) : (void *)colors);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
}

/* Copies parameters into a buffer, or returns them as they are. */
static const void *indirect(const void *commands, long bytes, int buffered)
{
	glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffered ? indirect_buffer : 0);
	if (!buffered)
		return commands;
	glBufferData(GL_DRAW_INDIRECT_BUFFER, bytes + 4, NULL, GL_STATIC_DRAW);
	glBufferSubData(GL_DRAW_INDIRECT_BUFFER, 4, bytes, commands);
	return (void *)4;
}

static void bind_indices(void)
{
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, element_buffer);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof(order), order, GL_STATIC_DRAW);
}

static void draw_arrays_indirect(int buffered)
{
	static const unsigned commands[2][4] = { { 9, 1, 3, 0 }, { 6, 2, 15, 1 } };

	point(!buffered, 0);
	glDrawArraysIndirect(GL_TRIANGLES, indirect(commands[0], sizeof(commands[0]), buffered));
	glMultiDrawArraysIndirect(GL_TRIANGLES, indirect(commands, sizeof(commands), buffered), 2, 0);
}

static void draw_elements_indirect(int buffered)
{
	static const unsigned commands[2][6] = { { 9, 1, 3, 0, 0 }, { 12, 1, 18, (unsigned)-1, 0 } };

	for (int i = 18; i < 30; i++)
		order[i] = (unsigned short)(1 + i * 7 % (N - 1));
	point(0, buffered);
	bind_indices();
	glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, indirect(commands[0], sizeof(commands[0]), buffered));
	glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, indirect(commands, sizeof(commands), buffered), 2,
	                            sizeof(commands[0]));
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
}

static void draw_instanced(void)
{
	static const int counts[2] = { 6, 3 }, bases[2] = { 0, 12 };
	const void *const many[2] = { order, order + 6 };

	for (int i = 0; i < 12; i++)
		order[i] = (unsigned short)i;
	point(0, 1);
	glDrawArraysInstanced(GL_TRIANGLES, 6, 6, 3);
	glDrawElementsInstanced(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, order, 2);
	glDrawElementsInstancedBaseVertex(GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, order, 2, 15);
	glDrawRangeElementsBaseVertex(GL_TRIANGLES, 0, 5, 3, GL_UNSIGNED_SHORT, order, 3);
	glMultiDrawElementsBaseVertex(GL_TRIANGLES, counts, GL_UNSIGNED_SHORT, many, 2, bases);
}

static void draw_elements_of_arrays(int buffered_positions)
{
	point(buffered_positions, !buffered_positions);
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < N; i++)
		glArrayElement((i * 5 + 2) % N);
	glEnd();
	glDrawArrays(GL_TRIANGLES, 0, 3); /* both arrays are still enabled */
}

static void draw_restarted(void)
{
	for (int i = 0; i < 2 * N; i++)
		order[i] = i % 7 == 6 ? 4000 : (unsigned short)(i % N);
	point(0, 0);
	glEnableClientState(GL_PRIMITIVE_RESTART_NV);
	glPrimitiveRestartIndexNV(4000);
	glDrawElements(GL_TRIANGLE_STRIP, 2 * N, GL_UNSIGNED_SHORT, order);
	glDisableClientState(GL_PRIMITIVE_RESTART_NV);
	order[1] = 2;
	glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, order);
}

int main(void)
{
	static const char *const needed[] = { "GL_ARB_multi_draw_indirect", "GL_NV_primitive_restart", "GL_ARB_draw_instanced",
		                              "GL_ARB_draw_elements_base_vertex" };

	open_window();
	for (int i = 0; i < 4; i++)
		if (!strstr((const char *)glGetString(GL_EXTENSIONS), needed[i]))
			return 77;
	glGenBuffers(1, &array_buffer);
	glGenBuffers(1, &element_buffer);
	glGenBuffers(1, &indirect_buffer);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	for (int frame = 0; frame < 8; frame++) {
		glClear(GL_COLOR_BUFFER_BIT);
		fill(frame);
		switch (frame) {
		case 0: draw_instanced(); break;
		case 1: draw_restarted(); break;
		case 2: case 3: draw_arrays_indirect(frame == 3); break;
		case 4: case 5: draw_elements_indirect(frame == 5); break;
		default: draw_elements_of_arrays(frame == 7);
		}
		expect(glGetError() == GL_NO_ERROR, "no error");
		end_frame();
	}
	return 0;
}
