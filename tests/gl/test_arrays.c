/* Vertex arrays and buffer objects (GL 2.1 sec. 2.8, 2.9). */
#include <math.h>

#include "base/err.h"
#include "base/bytes.h"
#include "replay/index/snapshot.h"
#include "tests/gl/gl.h"
#include "replay/machine/buffer.h"

static const float square[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
static const uint8_t colors[4][4] = {
	{ 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 }, { 255, 255, 255, 0 }
};

static void client_arrays(struct gl *gl)
{
	gl_call(gl, "glEnableClientState", "e", GL_VERTEX_ARRAY);
	gl_call(gl, "glEnableClientState", "e", GL_COLOR_ARRAY);
	gl_call(gl, "glVertexPointer", "ieib", 2, GL_FLOAT, 0, sizeof(square), square);
	gl_call(gl, "glColorPointer", "ieib", 4, GL_UNSIGNED_BYTE, 0, sizeof(colors), colors);
}

START_TEST(test_client_arrays)
{
	static const uint16_t indices[] = { 2, 3, 0, 2, 3, 1 };
	struct gl gl = gl_open();
	const struct scene_mesh *m;
	struct scene *s;

	client_arrays(&gl);
	gl_call(&gl, "glDrawArrays", "eii", GL_QUADS, 0, 4);
	gl_call(&gl, "glDrawElements", "eieb", GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, sizeof(indices), indices);
	gl_call(&gl, "glDrawElements", "eieb", GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, sizeof(indices), indices);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_uint_eq(s->n_meshes, 2);
	m = s->meshes[s->instances[0].mesh];
	ck_assert_floats(16, m->position, 0, 0, 0, 1, 1, 0, 0, 1, 1, 1, 0, 1, 0, 1, 0, 1);
	ck_assert_floats(16, m->color, 1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 0);
	m = s->meshes[s->instances[1].mesh]; /* vertices in order of first use: 2 3 0 1 */
	ck_assert_uint_eq(m->vertex_count, 4);
	ck_assert_floats(4, m->position, 1, 1, 0, 1);
	ck_assert_mem_eq(m->index, ((uint32_t[]){ 0, 1, 2, 0, 1, 3 }), 24);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Integers normalized to [-1,1]: for signed types in arrays the two lowest are both -1 and 0 maps to 0, which single
 * calls cannot represent (measured on Mesa 22.3.6). */
START_TEST(test_normalized)
{
	static const int8_t bytes[4] = { 100, -100, 0, -128 };
	static const int16_t shorts[4] = { 20000, -20000, 0, -32768 };
	static const int32_t ints[4] = { 1500000000, -1500000000, 0, INT32_MIN };
	static const uint32_t packed = 300 | (0x3ff & -300) << 10 | 2u << 30;
	static const uint8_t unsigned_bytes[4] = { 100, 155, 0, 255 };
	static const struct { uint32_t type; size_t n; const void *values; float first, last; } table[] = {
		{ GL_BYTE, 4, bytes, 100 * (1 / 127.0f), -1 }, { GL_SHORT, 8, shorts, 20000 * (1 / 32767.0f), -1 },
		{ GL_INT, 16, ints, 1.5e9f * (1 / 2147483647.0f), -1 }, { GL_INT_2_10_10_10_REV, 4, &packed, 300 * (1 / 511.0f), -1 },
		{ GL_UNSIGNED_BYTE, 4, unsigned_bytes, 100 * (1 / 255.0f), 1 } };
	struct gl gl = gl_open();

	client_arrays(&gl);
	for (size_t i = 0; i < sizeof(table) / sizeof(*table); i++) {
		struct scene *s;
		const float *color;

		gl_call(&gl, "glColorPointer", "ieib", 4, table[i].type, 0, table[i].n, table[i].values);
		gl_call(&gl, "glDrawArrays", "eii", GL_POINTS, 0, 1);
		s = gl_swap(&gl);
		color = s->meshes[s->instances[0].mesh]->color;
		ck_assert(color[0] == table[i].first); /* to the last bit */
		ck_assert(color[1] == (table[i].type == GL_UNSIGNED_BYTE ? 155 * (1 / 255.0f) : -table[i].first));
		ck_assert(color[2] == 0 && color[3] == table[i].last);
		scene_release(&s);
	}
	gl_call(&gl, "glDisableClientState", "e", GL_COLOR_ARRAY);
	gl_close(&gl);
}
END_TEST

/* Buffers: interleaved, strides and offsets, indices in a buffer, new contents, mapped memory. */
START_TEST(test_buffers)
{
	static const struct { float position[3]; uint8_t color[4]; } data[3] = {
		{ { 0, 0, 5 }, { 255, 0, 0, 255 } }, { { 1, 0, 5 }, { 0, 255, 0, 255 } }, { { 0, 1, 5 }, { 0, 0, 255, 255 } } };
	static const uint8_t indices[] = { 9, 0, 1, 2 };
	static const float nine = 9;
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glBindBuffer", "eu", GL_ARRAY_BUFFER, 3u);
	gl_call(&gl, "glBufferData", "eibe", GL_ARRAY_BUFFER, (int)sizeof(data), sizeof(data), data, GL_STATIC_DRAW);
	gl_call(&gl, "glVertexPointer", "ieip", 3, GL_FLOAT, 16, (uint64_t)0);
	gl_call(&gl, "glColorPointer", "ieip", 4, GL_UNSIGNED_BYTE, 16, (uint64_t)12);
	gl_call(&gl, "glBindBuffer", "eu", GL_ARRAY_BUFFER, 0u);
	gl_call(&gl, "glBindBuffer", "eu", GL_ELEMENT_ARRAY_BUFFER, 4u);
	gl_call(&gl, "glBufferData", "eibe", GL_ELEMENT_ARRAY_BUFFER, 4, sizeof(indices), indices, GL_STATIC_DRAW);
	gl_call(&gl, "glEnableClientState", "e", GL_VERTEX_ARRAY);
	gl_call(&gl, "glEnableClientState", "e", GL_COLOR_ARRAY);
	gl_call(&gl, "glDrawElements", "eiep", GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, (uint64_t)1);
	gl_call(&gl, "glDrawElements", "eiep", GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, (uint64_t)0); /* index 9: zeros */
	gl_call(&gl, "glBindBuffer", "eu", GL_ARRAY_BUFFER, 3u);
	gl_call_address(&gl, 0x7000, "glMapBuffer", "ee", GL_ARRAY_BUFFER, GL_WRITE_ONLY);
	gl_call(&gl, "memcpy", "pbi", (uint64_t)0x7000 + 16, sizeof(nine), &nine, 4);
	gl_call(&gl, "glUnmapBuffer", "e", GL_ARRAY_BUFFER);
	gl_call(&gl, "glDrawElements", "eiep", GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, (uint64_t)1);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_floats(12, s->meshes[0]->position, 0, 0, 5, 1, 1, 0, 5, 1, 0, 1, 5, 1);
	ck_assert_floats(4, s->meshes[0]->color + 8, 0, 0, 1, 1);
	ck_assert_floats(8, s->meshes[1]->position, 0, 0, 0, 1, 0, 0, 5, 1);
	ck_assert_floats(8, s->meshes[1]->color, 0, 0, 0, 0, 1, 0, 0, 1);
	ck_assert_floats(5, s->meshes[2]->position, 0, 0, 5, 1, 9);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A list takes the arrays' contents at the time it is compiled. */
START_TEST(test_into_list)
{
	static const float moved[4][2] = { { 5, 0 }, { 6, 0 }, { 6, 1 }, { 5, 1 } };
	struct gl gl = gl_open();
	struct scene *s;

	client_arrays(&gl);
	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	gl_call(&gl, "glDrawArrays", "eii", GL_QUADS, 0, 4);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glVertexPointer", "ieib", 2, GL_FLOAT, 0, sizeof(moved), moved);
	gl_call(&gl, "glCallList", "u", 1u);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	ck_assert_floats(1, s->meshes[0]->position, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A frame with one triangle from the enabled arrays, by glArrayElement. */
static struct scene *triangle_of_elements(struct gl *gl)
{
	struct scene *s;

	gl_call(gl, "glBegin", "e", GL_TRIANGLES);
	for (int i = 0; i < 3; i++)
		gl_call(gl, "glArrayElement", "i", i);
	gl_call(gl, "glEnd", "");
	s = gl_swap(gl);
	ck_assert_uint_eq(s->n_primitives, 1);
	return s;
}

START_TEST(test_array_element)
{
	struct gl gl = gl_open();
	struct scene *s;

	client_arrays(&gl);
	s = triangle_of_elements(&gl);
	ck_assert_floats(8, s->meshes[0]->color, 1, 0, 0, 1, 0, 1, 0, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A secondary colour in a buffer, in BGRA order (EXT_vertex_array_bgra). Beyond the buffer's end it is (0, 0, 0). */
START_TEST(test_array_element_bgra)
{
	struct gl gl = gl_open();
	struct scene *s;

	client_arrays(&gl);
	gl_call(&gl, "glBindBuffer", "eu", GL_ARRAY_BUFFER, 3u);
	gl_call(&gl, "glBufferData", "eibe", GL_ARRAY_BUFFER, 8, (size_t)8, colors, GL_STATIC_DRAW);
	gl_call(&gl, "glSecondaryColorPointer", "ieip", (int)GL_BGRA, GL_UNSIGNED_BYTE, 0, (uint64_t)0);
	gl_call(&gl, "glEnableClientState", "e", GL_SECONDARY_COLOR_ARRAY);
	s = triangle_of_elements(&gl);
	ck_assert_floats(12, s->meshes[0]->secondary, 0, 0, 1, 1, 0, 1, 0, 1, 0, 0, 0, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Table 2.5. */
START_TEST(test_interleaved)
{
	static const float t2f_n3f_v3f[3][8] = {
		{ 0, 0, 0, 0, 1, 0, 0, 7 }, { 1, 0, 0, 0, 1, 1, 0, 7 }, { 0, 1, 0, 0, 1, 0, 1, 7 } };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glInterleavedArrays", "eib", GL_T2F_N3F_V3F, 0, sizeof(t2f_n3f_v3f), t2f_n3f_v3f);
	gl_call(&gl, "glDrawArrays", "eii", GL_TRIANGLES, 0, 3);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->meshes[0]->attributes, SCENE_HAS_NORMAL | SCENE_HAS_TEXCOORD);
	ck_assert_floats(4, s->meshes[0]->position, 0, 0, 7, 1);
	ck_assert_floats(8, s->meshes[0]->texcoord[0], 0, 0, 0, 1, 1, 0, 0, 1);
	ck_assert_floats(3, s->meshes[0]->normal, 0, 0, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

START_TEST(test_errors_and_shortness)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glDrawArrays", "eii", GL_TRIANGLES, 0, 3); /* no vertex array: draws nothing, without an error */
	ck_assert_uint_eq(gl_error(&gl), 0);
	client_arrays(&gl);
	gl_call(&gl, "glDrawArrays", "eii", GL_TRIANGLES, 0, -1);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glDrawArrays", "eii", 44u, 0, 3);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glDrawElements", "eiep", GL_TRIANGLES, 3, GL_FLOAT, (uint64_t)0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glDrawArrays", "eii", GL_TRIANGLES, 2, 3); /* more than was recorded */
	ck_assert_uint_eq(gl_unsupported(&gl), 1);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/*
 * NV_primitive_restart and GL 3.1 sec. 2.8.3: a restart index, the highest of its type, a call between Begin and End.
 */
START_TEST(test_restart)
{
	static const uint8_t indices[] = { 0, 1, 2, 7, 1, 2, 3 }, highest[] = { 0, 1, 2, 255, 1, 2, 3 };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_VERTEX_ARRAY); /* as Mesa accepts it */
	gl_call(&gl, "glVertexPointer", "ieib", 2, GL_FLOAT, 0, sizeof(square), square);
	gl_call(&gl, "glEnableClientState", "e", GL_PRIMITIVE_RESTART_NV);
	gl_call(&gl, "glPrimitiveRestartIndexNV", "u", 7);
	gl_call(&gl, "glDrawElements", "eieb", GL_TRIANGLE_STRIP, 7, GL_UNSIGNED_BYTE, sizeof(indices), indices);
	gl_call(&gl, "glDisableClientState", "e", GL_PRIMITIVE_RESTART_NV);
	gl_call(&gl, "glEnable", "e", GL_PRIMITIVE_RESTART_FIXED_INDEX);
	gl_call(&gl, "glDrawElements", "eieb", GL_TRIANGLE_STRIP, 7, GL_UNSIGNED_BYTE, sizeof(highest), highest);
	gl_call(&gl, "glBegin", "e", GL_LINE_STRIP);
	for (int i = 0; i < 4; i++) {
		gl_call(&gl, "glVertex2i", "ii", i, 0);
		if (i == 1)
			gl_call(&gl, "glPrimitiveRestartNV", "");
	}
	gl_call(&gl, "glEnd", "");
	s = gl_swap(&gl);
	ck_assert_uint_eq(gl_error(&gl), 0);
	ck_assert_uint_eq(s->n_instances, 5);
	for (int i = 0; i < 4; i++)
		ck_assert_uint_eq(s->meshes[s->instances[i].mesh]->primitive_count, 1);
	ck_assert_uint_eq(s->meshes[s->instances[4].mesh]->primitive_count, 2);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* ARB_copy_buffer. */
START_TEST(test_copy_buffer)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glBindBuffer", "eu", GL_COPY_READ_BUFFER, 1);
	gl_call(&gl, "glBufferData", "eibe", GL_COPY_READ_BUFFER, (int)sizeof(square), sizeof(square), square, GL_STATIC_DRAW);
	gl_call(&gl, "glBindBuffer", "eu", GL_COPY_WRITE_BUFFER, 2);
	gl_call(&gl, "glBufferData", "eipe", GL_COPY_WRITE_BUFFER, 24, (uint64_t)0, GL_STATIC_DRAW);
	gl_call(&gl, "glCopyBufferSubData", "eeiii", GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 8, 0, 24);
	ck_assert_uint_eq(gl_error(&gl), 0);
	gl_call(&gl, "glCopyBufferSubData", "eeiii", GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 8, 8, 24);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glBindBuffer", "eu", GL_ARRAY_BUFFER, 2);
	gl_call(&gl, "glEnableClientState", "e", GL_VERTEX_ARRAY);
	gl_call(&gl, "glVertexPointer", "ieip", 2, GL_FLOAT, 0, (uint64_t)0);
	gl_call(&gl, "glDrawArrays", "eii", GL_TRIANGLES, 0, 3);
	s = gl_swap(&gl);
	ck_assert_floats(12, s->meshes[0]->position, 1, 0, 0, 1, 1, 1, 0, 1, 0, 1, 0, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Blobs stored by the hash that names them. */
static struct { uint64_t name[2]; void *data; size_t n; } kept[64];
static unsigned n_kept;

static int keep_blob(void *user, const uint64_t name[2], const void *data, size_t n)
{
	(void)user;
	ck_assert_uint_lt(n_kept, 64);
	memcpy(kept[n_kept].name, name, sizeof(kept[0].name));
	kept[n_kept].n = n;
	kept[n_kept].data = malloc(n);
	memcpy(kept[n_kept++].data, data, n);
	return 0;
}

static uint8_t *find_blob(void *user, const uint64_t name[2], size_t n)
{
	uint8_t *copy = malloc(n);

	(void)user;
	for (unsigned i = 0; i < n_kept; i++)
		if (memcmp(kept[i].name, name, sizeof(kept[i].name)) == 0 && kept[i].n == n)
			return memcpy(copy, kept[i].data, n);
	free(copy);
	return NULL;
}

static void draw_quad(struct gl *gl, uint32_t object, uint32_t attributes)
{
	struct scene *s;

	gl_call(gl, "glBindVertexArray", "u", object);
	gl_call(gl, "glDrawArrays", "eii", GL_QUADS, 0, 4);
	s = gl_swap(gl);
	if (attributes == UINT32_MAX) {
		ck_assert_uint_eq(s->n_instances, 0);
	} else {
		ck_assert_uint_eq(s->n_instances, 1);
		ck_assert_uint_eq(s->meshes[0]->attributes, attributes);
		ck_assert_floats(16, s->meshes[0]->position, 0, 0, 0, 1, 1, 0, 0, 1, 1, 1, 0, 1, 0, 1, 0, 1);
	}
	scene_release(&s);
}

/* Vertex array objects (GL 3.0 sec. 2.10): each has its own arrays, also after a checkpoint and on the attribute
 * stack. */
START_TEST(test_vertex_array_objects)
{
	const struct snapshot_blobs blobs = { .put = keep_blob, .get = find_blob };
	static const uint32_t names[] = { 3, 8 };
	struct gl gl = gl_open(), other = { 0 };
	struct bytes saved = { 0 }, again = { 0 };

	gl_call(&gl, "glBindVertexArray", "u", 3u);
	client_arrays(&gl);
	gl_call(&gl, "glBindBuffer", "eu", GL_ELEMENT_ARRAY_BUFFER, 5u);
	gl_call(&gl, "glBindVertexArrayAPPLE", "u", 8u);
	ck_assert_uint_eq(gl_state(&gl)->client.element_buffer, 0);
	client_arrays(&gl);
	gl_call(&gl, "glDisableClientState", "e", GL_COLOR_ARRAY);
	draw_quad(&gl, 3, SCENE_HAS_COLOR);
	ck_assert_uint_eq(gl_state(&gl)->client.element_buffer, 5);
	draw_quad(&gl, 0, UINT32_MAX);
	draw_quad(&gl, 8, 0);

	gl_call(&gl, "glPushClientAttrib", "m", GL_CLIENT_VERTEX_ARRAY_BIT);
	gl_call(&gl, "glBindVertexArray", "u", 3u);
	gl_call(&gl, "glPopClientAttrib", "");
	ck_assert_uint_eq(gl_state(&gl)->client.vertex_array, 8);
	draw_quad(&gl, 3, SCENE_HAS_COLOR);

	ck_assert_int_eq(snapshot_save(gl.x, &blobs, &saved), 0);
	ck_assert_int_eq(gls_exec_create(&other.x, "other"), 0);
	ck_assert_int_eq(snapshot_load(other.x, &blobs, saved.data, saved.n), 0);
	ck_assert_int_eq(snapshot_save(other.x, &blobs, &again), 0);
	ck_assert_uint_eq(saved.n, again.n);
	ck_assert_mem_eq(saved.data, again.data, saved.n);
	other.x->want = 1;
	draw_quad(&other, 8, 0);
	draw_quad(&other, 0, UINT32_MAX);
	draw_quad(&other, 3, SCENE_HAS_COLOR);
	gl_close(&other);

	gl_call(&gl, "glDeleteVertexArrays", "iU", 2, 2, names); /* 3 is bound */
	ck_assert_uint_eq(gl_state(&gl)->client.vertex_array, 0);
	draw_quad(&gl, 3, UINT32_MAX); /* a new one */
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	gl_close(&gl);
	free(saved.data);
	free(again.data);
	while (n_kept)
		free(kept[--n_kept].data);
}
END_TEST

/* Buffers that were never filled: nothing to copy or to draw. Undefined behaviour if unchecked (make check
 * SAN=undefined). */
START_TEST(test_empty_buffers)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glBindBuffer", "eu", GL_ARRAY_BUFFER, 3u);
	gl_call(&gl, "glBindBuffer", "eu", GL_ELEMENT_ARRAY_BUFFER, 4u);
	gl_call(&gl, "glBufferSubData", "eiib", GL_ARRAY_BUFFER, 0, 0, (size_t)0, "");
	gl_call(&gl, "glCopyBufferSubData", "eeiii", GL_ARRAY_BUFFER, GL_ELEMENT_ARRAY_BUFFER, 0, 0, 0);
	ck_assert_uint_eq(gl_error(&gl), 0);
	gl_call(&gl, "glDrawElements", "eiep", GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, (uint64_t)0);
	ck_assert_uint_eq(gl_unsupported(&gl), 1);
	/* larger than any buffer with contents */
	gl_call(&gl, "glBufferData", "eppe", GL_ARRAY_BUFFER, (uint64_t)1 << 31, (uint64_t)0, GL_STATIC_DRAW);
	ck_assert_uint_eq(gl_unsupported(&gl), 2);
	gl_close(&gl);
}
END_TEST

/* A buffer that is mapped again, and one mapped at another's old address: each has one address, and none once
 * unmapped. */
START_TEST(test_mapped_again)
{
	struct gl gl = gl_open();

	for (unsigned name = 3; name < 5; name++) {
		gl_call(&gl, "glBindBuffer", "eu", GL_ARRAY_BUFFER, name);
		gl_call(&gl, "glBufferData", "eipe", GL_ARRAY_BUFFER, 16, (uint64_t)0, GL_STATIC_DRAW);
		gl_call_address(&gl, 0x7000, "glMapBuffer", "ee", GL_ARRAY_BUFFER, GL_WRITE_ONLY);
		gl_call_address(&gl, 0x8000, "glMapBuffer", "ee", GL_ARRAY_BUFFER, GL_WRITE_ONLY);
		ck_assert_uint_eq(gl.x->maps.n, 1);
	}
	gl_call(&gl, "memcpy", "pbi", (uint64_t)0x8000, (size_t)1, "x", 1);
	ck_assert_uint_eq(gls_buffer_find(gl_state(&gl), 3)->data[0], 0);
	ck_assert_uint_eq(gls_buffer_find(gl_state(&gl), 4)->data[0], 'x');
	gl_call(&gl, "glDeleteBuffers", "iU", 2, 2, ((uint32_t[2]){ 3, 4 }));
	ck_assert_uint_eq(gl.x->maps.n, 0);
	gl_call(&gl, "memcpy", "pbi", (uint64_t)0x7000, (size_t)1, "x", 1);
	gl_close(&gl);
}
END_TEST

/* IBM_multimode_draw_arrays: each draw has its own mode, with a stride in bytes; an invalid mode draws nothing. */
START_TEST(test_modes)
{
	static const float positions[4][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 } };
	static const uint8_t indices[2] = { 3, 1 };
	const uint32_t modes[3] = { GL_TRIANGLES, GL_LINES, GL_POINTS }, first[3] = { 0, 1, 0 }, count[3] = { 3, 2, 1 };
	const struct trace_value blob = { .type = TRACE_BLOB, .count = 2, .blob = indices };
	struct trace_value args[6];
	struct call_sig sig = { .name = "glMultiModeDrawElementsIBM", .n_args = 6 };
	struct call call = { .sig = &sig, .args = args, .n_args = 6 };
	struct gl gl = gl_open();
	struct scene *s;

	sig.command = gls_command_find(sig.name);
	gl_call(&gl, "glEnableClientState", "e", GL_VERTEX_ARRAY);
	gl_call(&gl, "glVertexPointer", "ieib", 2, GL_FLOAT, 0, sizeof(positions), positions);
	gl_call(&gl, "glMultiModeDrawArraysIBM", "UUUii", 3, modes, 3, first, 3, count, 3, 8);
	for (unsigned i = 0; i < 6; i++)
		args[i] = (struct trace_value){ .type = TRACE_UINT, .u = i == 2 ? GL_UNSIGNED_BYTE : i == 4 ? 1 : 4 };
	args[0] = (struct trace_value){ .type = TRACE_ARRAY,
		                        .count = 1,
		                        .items = &(struct trace_value){ .type = TRACE_UINT, .u = GL_LINES } };
	args[1] = (struct trace_value){ .type = TRACE_ARRAY,
		                        .count = 1,
		                        .items = &(struct trace_value){ .type = TRACE_UINT, .u = 2 } };
	args[3] = (struct trace_value){ .type = TRACE_ARRAY, .count = 1, .items = &blob };
	ck_assert_int_eq(gls_exec_call(gl.x, &call), 0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_uint_eq(s->meshes[s->instances[0].mesh]->kind, SCENE_TRIANGLES);
	ck_assert_uint_eq(s->meshes[s->instances[1].mesh]->kind, SCENE_POINTS);
	ck_assert_uint_eq(s->meshes[s->instances[2].mesh]->kind, SCENE_LINES);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Instances become draws; the endless instances of a damaged recording are counted but not drawn. */
START_TEST(test_instances)
{
	uint32_t commands[4 * 64];
	struct gl gl = gl_open();
	struct scene *s;

	for (unsigned i = 0; i < 64; i++)
		memcpy(commands + 4 * i, ((uint32_t[4]){ 3, 60000, 0, 0 }), 16);
	client_arrays(&gl);
	gl_call(&gl, "glDrawArraysInstanced", "eiii", GL_TRIANGLES, 0, 3, 1000);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	gl_call(&gl, "glMultiDrawArraysIndirect", "ebii", GL_TRIANGLES, sizeof(commands), commands, 64, 16);
	ck_assert_uint_eq(gl_unsupported(&gl), 63);
	gl_call(&gl, "glDrawArraysInstanced", "eiii", GL_TRIANGLES, 0, 3, INT32_MAX);
	ck_assert_uint_eq(gl_unsupported(&gl), 64);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 61000);
	scene_release(&s);
	gl_call(&gl, "glDrawArraysInstanced", "eiii", GL_TRIANGLES, 0, 3, 60000);
	ck_assert_uint_eq(gl_unsupported(&gl), 64);
	gl_close(&gl);
}
END_TEST

GL_TESTS("arrays", test_modes, test_instances, test_mapped_again, test_restart, test_copy_buffer, test_client_arrays,
         test_normalized, test_buffers, test_empty_buffers, test_into_list, test_array_element, test_array_element_bgra,
         test_interleaved, test_errors_and_shortness, test_vertex_array_objects)
