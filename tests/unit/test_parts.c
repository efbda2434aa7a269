/* Draws and images written with some of their parts removed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "gl_tokens.h"
#include "tests/case.h"
#include "verbs/recording/parts.h"

static char from[] = "/tmp/test_parts.XXXXXX", to[sizeof(from) + 4];

/* A trace with only the stream header. */
#define EMPTY "at\5\0\0\0\3\10\6\6\0"

/* Write a call with some of its parts, and read the result. n: receives the number of calls */
static struct trace_reader *cut(const struct call *call, const char *in, size_t *n)
{
	struct trace_reader *reader = NULL;
	struct trace_out *out = NULL;
	uint8_t parts[16];

	ck_assert_uint_eq(parts_count(call), strlen(in));
	for (size_t i = 0; i < strlen(in); i++)
		parts[i] = in[i] == 'x';
	*n = parts_calls(call, parts);
	ck_assert_int_eq(trace_reader_open(&reader, from, NULL), 0);
	ck_assert_int_eq(trace_out_open(&out, to, from, reader), 0);
	ck_assert_int_eq(parts_write(out, call, parts), 0);
	ck_assert_int_eq(trace_out_finish(&out, NULL), 0);
	trace_reader_close(&reader);
	ck_assert_int_eq(trace_reader_open(&reader, to, NULL), 0);
	return reader;
}

static const struct call_sig arrays = { 10, "glDrawArrays", 3, (const char *[]){ "mode", "first", "count" }, -1 };
static const struct call_sig elements = { 11, "glDrawElements", 4,
	                                  (const char *[]){ "mode", "count", "type", "indices" }, -1 };
static const struct call_sig image = {
	12, "glTexImage1D", 8,
	(const char *[]){ "target", "level", "internalformat", "width", "border", "format", "type", "pixels" }, -1
};

#define NUMBER(x) { .type = TRACE_UINT, .u = (x) }

/* Remaining runs become separate draws; strips keep the facing of their triangles; the last part may be short. */
START_TEST(arrays_by_mode)
{
	static const struct {
		uint64_t mode, count;
		const char *in;
		uint64_t calls, draws[2][2]; /* first, count */
	} rows[] = {
		{ GL_TRIANGLES, 12, "xxxx", 1, { { 7, 12 } } },
		{ GL_TRIANGLES, 12, "x.xx", 2, { { 7, 3 }, { 13, 6 } } },
		{ GL_TRIANGLES, 13, "....x", 1, { { 19, 1 } } },
		{ GL_TRIANGLES, 12, "....", 0, { { 0 } } },
		{ GL_POINTS, 3, ".x.", 1, { { 8, 1 } } },
		{ GL_LINES, 4, ".x", 1, { { 9, 2 } } },
		{ GL_QUADS, 8, "x.", 1, { { 7, 4 } } },
		{ GL_LINE_STRIP, 4, ".x.", 1, { { 8, 2 } } },
		{ GL_TRIANGLE_STRIP, 7, "..x", 1, { { 11, 3 } } },
		{ GL_TRIANGLE_STRIP, 7, ".x.", 1, { { 9, 4 } } },
		{ GL_QUAD_STRIP, 8, "x.x", 2, { { 7, 4 }, { 11, 4 } } },
		{ GL_TRIANGLE_FAN, 8, "", 0, { { 0 } } },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		const struct trace_value args[] = { NUMBER(rows[i].mode), NUMBER(7), NUMBER(rows[i].count) };
		const struct call call = { .sig = &arrays, .n_args = 3, .args = args }, *got;
		struct trace_reader *reader;
		size_t n;

		if (!*rows[i].in) {
			ck_assert_uint_eq(parts_count(&call), 0);
			continue;
		}
		reader = cut(&call, rows[i].in, &n);
		ck_assert_uint_eq(n, rows[i].calls);
		for (size_t d = 0; d < n; d++) {
			ck_assert_int_eq(trace_reader_next(reader, &got), 1);
			ck_assert_uint_eq(got->args[0].u, rows[i].mode);
			ck_assert_uint_eq(got->args[1].u, rows[i].draws[d][0]);
			ck_assert_uint_eq(got->args[2].u, rows[i].draws[d][1]);
		}
		ck_assert_int_eq(trace_reader_next(reader, &got), 0);
		trace_reader_close(&reader);
	}
}
END_TEST

/*
 * Inline indices are cut, a buffer offset is advanced; if there are fewer indices than the count, the draw is
 * unchanged.
 */
START_TEST(elements_by_place)
{
	static const uint8_t indices[] = { 0, 0, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0 };
	struct trace_value args[] = { NUMBER(GL_TRIANGLES),
		                      NUMBER(6),
		                      NUMBER(GL_UNSIGNED_SHORT),
		                      { .type = TRACE_BLOB, .count = 12, .blob = indices } };
	const struct call call = { .sig = &elements, .n_args = 4, .args = args }, *got;
	struct trace_reader *reader;
	size_t n;

	reader = cut(&call, ".x", &n);
	ck_assert_int_eq(trace_reader_next(reader, &got), 1);
	ck_assert_uint_eq(got->args[1].u, 3);
	ck_assert_uint_eq(got->args[3].count, 6);
	ck_assert_mem_eq(got->args[3].blob, indices + 6, 6);
	trace_reader_close(&reader);
	args[3].count = 11;
	ck_assert_uint_eq(parts_count(&call), 0);
	args[3] = (struct trace_value){ .type = TRACE_NULL };
	reader = cut(&call, ".x", &n);
	ck_assert_int_eq(trace_reader_next(reader, &got), 1);
	ck_assert_uint_eq(got->args[3].u, 6);
	trace_reader_close(&reader);
	args[3] = (struct trace_value){ .type = TRACE_OPAQUE, .u = 100 };
	reader = cut(&call, ".x", &n);
	ck_assert_int_eq(trace_reader_next(reader, &got), 1);
	ck_assert_uint_eq(got->args[3].u, 106);
	trace_reader_close(&reader);
	args[2].u = GL_FLOAT;
	ck_assert_uint_eq(parts_count(&call), 0);
}
END_TEST

/* The image call stays, without its texels. */
START_TEST(texels)
{
	static const uint8_t bytes[4];
	struct trace_value args[8] = { NUMBER(GL_TEXTURE_1D),
		                       NUMBER(0),
		                       NUMBER(GL_RGBA),
		                       NUMBER(1),
		                       NUMBER(0),
		                       NUMBER(GL_RGBA),
		                       NUMBER(GL_UNSIGNED_BYTE),
		                       { .type = TRACE_BLOB, .count = 4, .blob = bytes } };
	const struct call call = { .sig = &image, .n_args = 8, .args = args }, *got;
	struct trace_reader *reader;
	size_t n;

	for (int kept = 0; kept < 2; kept++) {
		reader = cut(&call, kept ? "x" : ".", &n);
		ck_assert_uint_eq(n, 1);
		ck_assert_int_eq(trace_reader_next(reader, &got), 1);
		ck_assert_uint_eq(got->args[3].u, 1);
		ck_assert_int_eq(got->args[7].type, kept ? TRACE_BLOB : TRACE_NULL);
		trace_reader_close(&reader);
	}
	args[7] = (struct trace_value){ .type = TRACE_OPAQUE, .u = 16 };
	ck_assert_uint_eq(parts_count(&call), 0);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("parts");
	const int file = mkstemp(from);
	int failed;

	if (file < 0 || write(file, EMPTY, 11) != 11 || close(file))
		return 1;
	snprintf(to, sizeof(to), "%s.new", from);
	tcase_add_test(tcase, arrays_by_mode);
	tcase_add_test(tcase, elements_by_place);
	tcase_add_test(tcase, texels);
	failed = run_case(tcase, "parts");
	unlink(from);
	unlink(to);
	return failed;
}
