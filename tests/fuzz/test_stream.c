/* Streams with changed calls must still be read to their ends, or they would not pass the reader. */
#include <snappy-c.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "replay/trace/container.h"
#include "replay/trace/reader.h"
#include "tests/case.h"
#include "tests/fuzz/calls.h"
#include "tests/fuzz/stream.h"

#define ROOM ((size_t)1 << 20)
#define N_CHANGES 300

static uint8_t two_triangles[ROOM], cornell[ROOM];
static size_t n_two_triangles, n_cornell;

static size_t unpack(const char *path, uint8_t *out)
{
	struct container *c;
	const uint8_t *piece;
	size_t n, all = 0;

	ck_assert_int_eq(container_open(&c, path), 0);
	for (; container_next(c, &piece, &n) == 1; all += n) {
		ck_assert_uint_le(n, ROOM - all);
		memcpy(out + all, piece, n);
	}
	container_close(&c);
	return all;
}

static void setup(void)
{
	n_two_triangles = unpack("tests/golden/two_triangles.trace", two_triangles);
	n_cornell = unpack("tests/golden/cornell.trace", cornell);
}

/* The number of calls in a stream, or -1 if it is damaged or truncated. */
static long count_calls(const uint8_t *stream, size_t size)
{
	char path[] = "/tmp/stream-XXXXXX";
	size_t n = snappy_max_compressed_length(size);
	char *packed = malloc(n);
	struct trace_reader *r;
	const struct call *call;
	int file = mkstemp(path), rc;
	long calls = 0;
	uint32_t length;

	ck_assert(packed && file >= 0 && snappy_compress((const char *)stream, size, packed, &n) == SNAPPY_OK);
	length = (uint32_t)n;
	ck_assert(write(file, "at", 2) == 2 && write(file, &length, 4) == 4 && write(file, packed, n) == (ssize_t)n);
	close(file);
	free(packed);
	ck_assert_int_eq(trace_reader_open(&r, path, NULL), 0);
	while ((rc = trace_reader_next(r, &call)) == 1)
		calls++;
	if (rc < 0 || trace_reader_is_cut(r))
		calls = -1;
	trace_reader_close(&r);
	unlink(path);
	return calls;
}

START_TEST(changed_streams_are_read)
{
	static uint8_t out[ROOM];
	long whole = count_calls(cornell, n_cornell), most = 0, least = whole;
	unsigned state = 1;

	for (int i = 0; i < N_CHANGES; i++) {
		size_t n = stream_change(cornell, n_cornell, i % 2 ? two_triangles : NULL, n_two_triangles, out, ROOM, &state);
		long calls = count_calls(out, n);
		ck_assert_msg(calls > 0, "change %d: damaged", i);
		most = calls > most ? calls : most;
		least = calls < least ? calls : least;
	}
	ck_assert_int_gt(most, whole);
	ck_assert_int_lt(least, whole);
}
END_TEST

START_TEST(changes_add_up)
{
	static uint8_t streams[2][ROOM];
	size_t n = n_cornell;
	unsigned state = 2;

	memcpy(streams[0], cornell, n);
	for (int i = 0; i < N_CHANGES; i++) {
		n = stream_change(streams[i % 2], n, two_triangles, n_two_triangles, streams[1 - i % 2], 65536, &state);
		ck_assert_msg(count_calls(streams[1 - i % 2], n) > 0, "change %d: damaged", i);
	}
}
END_TEST

START_TEST(what_is_no_stream)
{
	uint8_t out[64];
	unsigned state = 3;

	ck_assert_uint_eq(stream_change((const uint8_t *)"", 0, NULL, 0, out, sizeof(out), &state), 0);
	ck_assert_uint_eq(stream_change((const uint8_t *)"nonsense", 8, NULL, 0, out, sizeof(out), &state), 0);
	for (size_t n = 0; n < n_two_triangles && n < 3000; n += 7) /* truncated anywhere */
		ck_assert_uint_le(stream_change(two_triangles, n, NULL, 0, out, sizeof(out), &state), sizeof(out));
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("stream");

	tcase_add_unchecked_fixture(tcase, setup, NULL);
	tcase_add_test(tcase, changed_streams_are_read);
	tcase_add_test(tcase, changes_add_up);
	tcase_add_test(tcase, what_is_no_stream);
	return run_case(tcase, "stream");
}
