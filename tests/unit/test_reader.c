/* replay/reader: traces written here byte by byte, whole, truncated and damaged. */
#include "replay/trace/reader.h"

#include <snappy-c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>
#include <zlib.h>

#include "base/err.h"
#include "tests/case.h"

struct bytes {
	uint8_t data[3 << 16];
	size_t n;
};

static void put(struct bytes *b, const void *data, size_t n)
{
	ck_assert_uint_le(b->n + n, sizeof(b->data));
	memcpy(b->data + b->n, data, n);
	b->n += n;
}

static void put_uint(struct bytes *b, uint64_t value)
{
	uint8_t byte;

	do {
		byte = (uint8_t)(value & 0x7f) | (value > 0x7f ? 0x80 : 0);
		put(b, &byte, 1);
		value >>= 7;
	} while (value);
}

static void put_string(struct bytes *b, const char *s)
{
	put_uint(b, strlen(s));
	put(b, s, strlen(s));
}

static void put_header(struct bytes *b)
{
	put(b, "\6\6", 2);
	put_string(b, "process.name");
	put_string(b, "/bin/test");
	put_string(b, "");
}

#define PIECE_BYTES 65536 /* from this size on, the container delivers chunks separately */

/* A header so long that its chunk is a piece of its own. */
static void put_long_header(struct bytes *b)
{
	static char filler[PIECE_BYTES + 1];

	memset(filler, 'x', PIECE_BYTES);
	put(b, "\6\6", 2);
	put_string(b, "filler");
	put_string(b, filler);
	put_string(b, "process.name");
	put_string(b, "/bin/test");
	put_string(b, "");
}

/* Two calls of glVertex2f; the second omits the signature and has arguments of every type. */
static void put_calls(struct bytes *b)
{
	const float f = 1.5f;
	const double d = -2.25;

	put(b, "\0\0", 2); /* ENTER of thread 0 */
	put_uint(b, 9);
	put_string(b, "glVertex2f");
	put_uint(b, 2);
	put_string(b, "x");
	put_string(b, "y");
	put(b, "\1\0\5", 3);
	put(b, &f, 4);
	put(b, "\1\1\3\7", 4); /* -7 */
	put(b, "\0", 1);
	put(b, "\1\0\0", 3); /* LEAVE of call 0 */

	put(b, "\0\3", 2);
	put_uint(b, 9);
	put(b, "\5\1", 2); /* fake */
	put(b, "\1\0\6", 3);
	put(b, &d, 8);
	put(b, "\1\1\x0b\5\7\3abc\x0a\1\1\4MASK\2\2\0\x0d\x10", 22); /* { "abc", MASK, NULL, 0x10, */
	put(b, "\x09\4\1\6GL_ONE\4\1\4\1", 14); /* GL_ONE } */
	put(b, "\1\5\x08\4\1\2\3\4", 8); /* an argument beyond the signature: a blob */
	put(b, "\0", 1);
	put(b, "\1\1\2\4\x96\1\0", 7); /* returns 150 */
}

static const char *path_of(const char *name)
{
	static char path[256];
	const char *folder = getenv("TMPDIR");

	snprintf(path, sizeof(path), "%s/relume-reader-%d-%s", folder ? folder : "/tmp", (int)getpid(), name);
	return path;
}

static const char *write_file(const void *data, size_t n)
{
	const char *path = path_of("trace");
	FILE *file = fopen(path, "wb");

	ck_assert_ptr_nonnull(file);
	ck_assert_uint_eq(fwrite(data, 1, n, file), n);
	ck_assert_int_eq(fclose(file), 0);
	return path;
}

static size_t pack_chunk(const uint8_t *data, size_t here, uint8_t *out)
{
	size_t packed = snappy_max_compressed_length(here);

	ck_assert_int_eq(snappy_compress((const char *)data, here, (char *)out + 4, &packed), SNAPPY_OK);
	for (unsigned i = 0; i < 4; i++)
		out[i] = (uint8_t)(packed >> (8 * i));
	return 4 + packed;
}

/* A Snappy container with chunks of `chunk` bytes. */
static size_t pack_snappy(const struct bytes *b, size_t chunk, uint8_t *out)
{
	size_t n = 2;

	memcpy(out, "at", 2);
	for (size_t at = 0; at < b->n; at += chunk)
		n += pack_chunk(b->data + at, b->n - at < chunk ? b->n - at : chunk, out + n);
	return n;
}

/* A Snappy container of two chunks. */
static size_t pack_in_two(const struct bytes *b, size_t first, uint8_t *out)
{
	size_t n = 2;

	memcpy(out, "at", 2);
	n += pack_chunk(b->data, first, out + n);
	return n + pack_chunk(b->data + first, b->n - first, out + n);
}

static int32_t find(const char *name)
{
	return strcmp(name, "glVertex2f") == 0 ? 7 : -1;
}

static void check_calls(const char *path)
{
	struct trace_reader *r;
	const struct call *c;
	const struct trace_value *v;

	ck_assert_int_eq(trace_reader_open(&r, path, find), 0);
	ck_assert_str_eq(trace_reader_property(r, "process.name"), "/bin/test");
	ck_assert_ptr_null(trace_reader_property(r, "other"));
	ck_assert_int_eq(trace_reader_next(r, &c), 1);
	ck_assert_str_eq(c->sig->name, "glVertex2f");
	ck_assert_str_eq(c->sig->arg_names[1], "y");
	ck_assert_int_eq(c->sig->command, 7);
	ck_assert_uint_eq(c->n_args, 2);
	ck_assert(c->args[0].type == TRACE_FLOAT && c->args[0].f == 1.5f);
	ck_assert(c->args[1].type == TRACE_SINT && c->args[1].i == -7);
	ck_assert_int_eq(c->ret.type, TRACE_NONE);
	ck_assert_int_eq(trace_reader_next(r, &c), 1);
	ck_assert_uint_eq(c->number, 1);
	ck_assert_uint_eq(c->thread, 3);
	ck_assert_uint_eq(c->flags, CALL_FAKE);
	ck_assert_uint_eq(c->n_args, 6);
	ck_assert(c->args[0].type == TRACE_DOUBLE && c->args[0].d == -2.25);
	v = c->args[1].items;
	ck_assert_uint_eq(c->args[1].count, 5);
	ck_assert_str_eq(v[0].str, "abc");
	ck_assert(v[1].type == TRACE_BITMASK && v[1].u == 2);
	ck_assert_int_eq(v[2].type, TRACE_NULL);
	ck_assert(v[3].type == TRACE_OPAQUE && v[3].u == 16);
	ck_assert(v[4].type == TRACE_ENUM && v[4].i == 1);
	ck_assert_str_eq(trace_enum_name(&v[4]), "GL_ONE");
	ck_assert_int_eq(c->args[3].type, TRACE_NONE);
	ck_assert_uint_eq(c->args[5].count, 4);
	ck_assert_mem_eq(c->args[5].blob, "\1\2\3\4", 4);
	ck_assert(c->ret.type == TRACE_UINT && c->ret.u == 150);
	ck_assert_int_eq(trace_reader_next(r, &c), 0);
	ck_assert_int_eq(trace_reader_next(r, &c), 0);
	ck_assert_ptr_null(c);
	ck_assert_int_eq(trace_reader_is_cut(r), 0);
	trace_reader_close(&r);
	ck_assert_ptr_null(r);
}

/* Events straddle chunks at any byte. */
START_TEST(test_snappy)
{
	struct bytes b = { .n = 0 };
	uint8_t file[65536];

	put_header(&b);
	put_calls(&b);
	for (size_t chunk = 1; chunk <= b.n; chunk += 1 + chunk / 4)
		check_calls(write_file(file, pack_snappy(&b, chunk, file)));
	unlink(path_of("trace"));
}
END_TEST

/* Also across pieces, which are read independently. */
START_TEST(test_pieces)
{
	static uint8_t file[8 * 32768];
	struct bytes b = { .n = 0 };
	size_t header;

	put_long_header(&b);
	header = b.n;
	put_calls(&b);
	for (size_t first = header; first < b.n; first++)
		check_calls(write_file(file, pack_in_two(&b, first, file)));
	unlink(path_of("trace"));
}
END_TEST

/* A number whose highest bit is `bit`. */
static uint64_t number_of(unsigned bit)
{
	return 0xb7e151628aed2a6bu >> (63 - bit);
}

/* For each length of a number, a call with such numbers in every position, and with arrays of 0 to 20 items. */
static void put_numbers(struct bytes *b)
{
	for (unsigned bit = 0; bit < 64; bit++) {
		const uint64_t v = number_of(bit);

		put(b, bit ? "\0\0\200\1" : "\0\0\200\1\1f\6\1u\1s\1p\1e\1m\1a", bit ? 4 : 19); /* signature 128 */
		put(b, "\1\0\4", 3);
		put_uint(b, v);
		put(b, "\1\1\3", 3);
		put_uint(b, v);
		put(b, "\1\2\x0d", 3);
		put_uint(b, v);
		put(b, bit ? "\1\3\x09\0" : "\1\3\x09\0\1\1E\4\0", bit ? 4 : 9);
		put(b, bit & 1 ? "\3" : "\4", 1);
		put_uint(b, v);
		put(b, bit ? "\1\4\x0a\0" : "\1\4\x0a\0\1\1M\1", bit ? 4 : 8);
		put_uint(b, v);
		put(b, "\1\5\x0b", 3);
		put_uint(b, bit % 21);
		for (unsigned i = 0; i < bit % 21; i++) {
			const float f = (float)bit + (float)i / 32;
			if (i % 5 == 4) {
				put(b, "\4", 1);
				put_uint(b, v);
			} else {
				put(b, "\5", 1);
				put(b, &f, 4);
			}
		}
		put(b, "\0\1", 2);
		put_uint(b, bit);
		put(b, "\2\4", 2);
		put_uint(b, v);
		put(b, "\0", 1);
	}
}

static void check_numbers(const char *path)
{
	struct trace_reader *r;
	const struct call *c;

	ck_assert_int_eq(trace_reader_open(&r, path, NULL), 0);
	for (unsigned bit = 0; bit < 64; bit++) {
		const uint64_t v = number_of(bit);
		const enum trace_type types[] = { TRACE_UINT, TRACE_SINT, TRACE_OPAQUE, TRACE_ENUM, TRACE_BITMASK, TRACE_ARRAY };

		ck_assert_int_eq(trace_reader_next(r, &c), 1);
		ck_assert_str_eq(c->sig->name, "f");
		ck_assert_uint_eq(c->number, bit);
		ck_assert_uint_eq(c->n_args, 6);
		for (unsigned i = 0; i < 6; i++)
			ck_assert_int_eq(c->args[i].type, types[i]);
		ck_assert_uint_eq(c->args[0].u, v);
		ck_assert_uint_eq(c->args[1].u, -v);
		ck_assert_uint_eq(c->args[2].u, v);
		ck_assert_uint_eq(c->args[3].u, bit & 1 ? -v : v);
		ck_assert_str_eq(((const struct trace_values_sig *)c->args[3].sig)->names[0], "E");
		ck_assert_uint_eq(c->args[4].u, v);
		ck_assert_str_eq(((const struct trace_values_sig *)c->args[4].sig)->names[0], "M");
		ck_assert_uint_eq(c->args[5].count, bit % 21);
		for (unsigned i = 0; i < bit % 21; i++) {
			const struct trace_value *item = &c->args[5].items[i];
			ck_assert_int_eq(item->type, i % 5 == 4 ? TRACE_UINT : TRACE_FLOAT);
			if (i % 5 == 4)
				ck_assert_uint_eq(item->u, v);
			else
				ck_assert_float_eq(item->f, (float)bit + (float)i / 32);
		}
		ck_assert_int_eq(c->ret.type, TRACE_UINT);
		ck_assert_uint_eq(c->ret.u, v);
	}
	ck_assert_int_eq(trace_reader_next(r, &c), 0);
	ck_assert_int_eq(trace_reader_is_cut(r), 0);
	trace_reader_close(&r);
}

/* Numbers of every length, in chunks that hold all of them down to single bytes. */
START_TEST(test_numbers)
{
	static uint8_t file[8 * 32768];
	struct bytes b = { .n = 0 };

	put_header(&b);
	put_numbers(&b);
	for (size_t chunk = b.n; chunk; chunk -= 1 + chunk / 4)
		check_numbers(write_file(file, pack_snappy(&b, chunk, file)));
	unlink(path_of("trace"));
}
END_TEST

START_TEST(test_numbers_over_pieces)
{
	static uint8_t file[8 * 32768];
	struct bytes b = { .n = 0 };
	size_t header;

	put_long_header(&b);
	header = b.n;
	put_numbers(&b);
	for (size_t first = header; first < b.n; first += 7)
		check_numbers(write_file(file, pack_in_two(&b, first, file)));
	unlink(path_of("trace"));
}
END_TEST

/* The file's hash does not depend on the order or extent of reads, or on data after its chunks. */
START_TEST(test_hash)
{
	static uint8_t file[8 * 32768];
	struct bytes b = { .n = 0 };
	struct trace_place begin = { .piece = UINT64_MAX };
	struct trace_reader *r;
	const struct call *c;
	const char *path;
	uint64_t got[2];
	XXH128_hash_t hash;
	size_t n;

	put_header(&b);
	put_numbers(&b);
	n = pack_snappy(&b, 100, file);
	memset(file + n, 0, 4); /* end of the chunks */
	for (n += 4; n < sizeof(file); n++)
		file[n] = (uint8_t)(n / 7);
	path = write_file(file, n);
	hash = XXH3_128bits(file, n);
	for (unsigned calls = 0; calls <= 80; calls += 16) {
		ck_assert_int_eq(trace_reader_open(&r, path, NULL), 0);
		ck_assert_int_eq(trace_reader_place(r, &begin), 1);
		ck_assert_int_eq(trace_reader_hash_begin(r), 0);
		for (unsigned i = 0; i < calls; i++)
			trace_reader_next(r, &c);
		if (calls == 48)
			ck_assert_int_eq(trace_reader_seek(r, &begin, NULL, 0), 0);
		ck_assert_int_eq(trace_reader_hash_end(r, got), 0);
		ck_assert(got[0] == hash.low64 && got[1] == hash.high64);
		trace_reader_close(&r);
	}
	unlink(path_of("trace"));
}
END_TEST

/* An offset beyond the end, as from the index of a longer recording. */
START_TEST(test_place_behind)
{
	static uint8_t file[8 * 32768];
	struct bytes b = { .n = 0 };
	struct trace_place place = { .piece = UINT64_MAX };
	struct trace_reader *r;
	const struct call *c;

	put_header(&b);
	put_numbers(&b);
	write_file(file, pack_snappy(&b, 100, file));
	ck_assert_int_eq(trace_reader_open(&r, path_of("trace"), NULL), 0);
	ck_assert_int_eq(trace_reader_place(r, &place), 1);
	place.offset = b.n + 1;
	ck_assert_int_eq(trace_reader_seek(r, &place, NULL, 0), ERR_INPUT);
	while (trace_reader_next(r, &c) == 1)
		;
	ck_assert_int_eq(trace_reader_seek(r, &place, NULL, 0), ERR_INPUT);
	trace_reader_close(&r);
	unlink(path_of("trace"));
}
END_TEST

START_TEST(test_gzip)
{
	struct bytes b = { .n = 0 };
	const char *path = path_of("trace");
	gzFile file = gzopen(path, "wb");

	put_header(&b);
	put_calls(&b);
	ck_assert_int_eq(gzwrite(file, b.data, (unsigned)b.n), (int)b.n);
	gzclose(file);
	check_calls(path);
	unlink(path);
}
END_TEST

/* Read to the end. @return calls delivered; *last receives the last result */
static unsigned read_all(const char *path, int *last)
{
	struct trace_reader *r;
	const struct call *c;
	unsigned n = 0;

	*last = trace_reader_open(&r, path, NULL);
	if (*last)
		return 0;
	while ((*last = trace_reader_next(r, &c)) == 1)
		n++;
	trace_reader_close(&r);
	return n;
}

/* Truncated at any byte: no error after the header, and complete calls are delivered. */
START_TEST(test_cut)
{
	struct bytes b = { .n = 0 };
	uint8_t file[65536];
	size_t n, header;
	unsigned calls = 0, before = 0;
	int rc;

	put_header(&b);
	header = b.n;
	put_calls(&b);
	n = pack_snappy(&b, 8192, file); /* a single chunk, unpacked as far as possible */
	for (size_t cut = 0; cut <= n; cut++) {
		calls = read_all(write_file(file, cut), &rc);
		ck_assert(rc == 0 || (rc == ERR_INPUT && calls == 0 && cut < 2 * header + 16));
		ck_assert_uint_ge(calls, before);
		before = calls;
	}
	ck_assert_uint_eq(calls, 2);
	unlink(path_of("trace"));
}
END_TEST

/* A damaged chunk does not affect earlier chunks delivered with it. */
START_TEST(test_damaged_chunk)
{
	struct bytes b = { .n = 0 };
	uint8_t file[65536];
	size_t first;
	int rc;

	put_header(&b);
	put_calls(&b);
	first = 2 + pack_chunk(b.data, b.n, file + 2);
	memcpy(file, "at", 2);
	memcpy(file + first, "\4\0\0\0\x08\xff\xff\xff", 8);
	ck_assert_uint_eq(read_all(write_file(file, first + 8), &rc), 2);
	ck_assert_int_eq(rc, ERR_INPUT);
	unlink(path_of("trace"));
}
END_TEST

/* Any byte changed to any of several values: there is a result, and memory stays in proportion to the file. */
START_TEST(test_damaged)
{
	static const uint8_t values[] = { 0, 1, 0x0b, 0x0c, 0x0e, 0x7f, 0x80, 0xff };
	struct bytes b = { .n = 0 };
	uint8_t file[65536];
	int rc;

	put_header(&b);
	put_calls(&b);
	for (size_t at = 0; at < b.n; at++)
		for (size_t v = 0; v < sizeof(values); v++) {
			struct bytes damaged = b;
			damaged.data[at] = values[v];
			read_all(write_file(file, pack_snappy(&damaged, 64, file)), &rc);
			ck_assert(rc == 0 || rc == ERR_INPUT);
		}
	unlink(path_of("trace"));
}
END_TEST

/* Counts that exceed the data, values without an end. */
START_TEST(test_impossible)
{
	static const char *const details[] = {
		"\1\0\x08\xff\xff\xff\xff\xff\xff\xff\xff\x7f", "\1\0\x08\xff\xff\xff\xff\x0f", "\1\0\x0b\xff\xff\xff\xff\x0f",
		"\1\0\x07\xff\xff\xff\xff\xff\x07", "\1\xff\xff\xff\xff\x7f\4\1", "\1\0\x10", "\3", "\7",
		"\1\0\4\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff",
		"\1\0\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e\x0e",
	};
	uint8_t file[65536];
	int rc;

	for (size_t i = 0; i < sizeof(details) / sizeof(details[0]); i++) {
		struct bytes b = { .n = 0 };
		put_header(&b);
		put(&b, "\0\0", 2);
		put_uint(&b, 1);
		put_string(&b, "glFlush");
		put_uint(&b, 0);
		put(&b, details[i], strlen(details[i]));
		ck_assert_uint_eq(read_all(write_file(file, pack_snappy(&b, 8192, file)), &rc), 0);
		ck_assert(rc == 0 || rc == ERR_INPUT);
	}
	unlink(path_of("trace"));
}
END_TEST

START_TEST(test_no_traces)
{
	static const struct { const char *bytes; size_t n; } files[] = {
		{ "", 0 }, { "\x89PNG\r\n\x1a\n....", 12 }, { "hello, world, this is no trace at all", 37 }, { "at", 2 },
		{ "at\xff\xff\xff\xff", 6 }, { "\x1f\x8b\x08garbage", 10 }, { "\x28\xb5\x2f\xfd....", 8 },
	};
	struct trace_reader *r;
	int rc;

	for (size_t i = 0; i < sizeof(files) / sizeof(files[0]); i++) {
		ck_assert_uint_eq(read_all(write_file(files[i].bytes, files[i].n), &rc), 0);
		ck_assert_int_eq(rc, ERR_INPUT);
	}
	unlink(path_of("trace"));
	ck_assert_int_eq(trace_reader_open(&r, "/nonexistent/trace", NULL), ERR_INPUT);
	ck_assert_int_eq(trace_reader_open(&r, "/", NULL), ERR_INPUT);
	ck_assert_ptr_null(r);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("reader");

	tcase_set_timeout(tcase, 60);
	tcase_add_test(tcase, test_snappy);
	tcase_add_test(tcase, test_pieces);
	tcase_add_test(tcase, test_numbers);
	tcase_add_test(tcase, test_numbers_over_pieces);
	tcase_add_test(tcase, test_hash);
	tcase_add_test(tcase, test_place_behind);
	tcase_add_test(tcase, test_gzip);
	tcase_add_test(tcase, test_cut);
	tcase_add_test(tcase, test_damaged_chunk);
	tcase_add_test(tcase, test_damaged);
	tcase_add_test(tcase, test_impossible);
	tcase_add_test(tcase, test_no_traces);
	return run_case(tcase, "reader");
}
