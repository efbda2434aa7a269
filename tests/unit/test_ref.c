/* The reader of reference frames: whole files, files truncated at every byte, and inconsistent files. */
#include <snappy-c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/err.h"
#include "capture/format/ref_pack.h"
#include "tests/case.h"

enum { WIDTH = 5, HEIGHT = 3, PIXEL_BYTES = WIDTH * HEIGHT * 4, N_FRAMES = 4 };

static char path[] = "/tmp/relume-test-ref-XXXXXX";
static uint8_t file[32768];
static size_t file_bytes;
static size_t record_end[N_FRAMES * 2];
static size_t most_at_once = SIZE_MAX;

/* Overrides the reader's pread: it returns less than requested, as network and user-space file systems may. */
ssize_t pread(int fd, void *to, size_t n, off_t at)
{
	return syscall(SYS_pread64, fd, to, n < most_at_once ? n : most_at_once, at);
}

static void put_le(uint64_t v, unsigned n)
{
	while (n--) {
		file[file_bytes++] = (uint8_t)v;
		v >>= 8;
	}
}

static void put_record(enum ref_kind kind, uint64_t frame, const void *pixels)
{
	char packed[256];
	size_t packed_bytes = sizeof(packed);

	ck_assert_int_eq(snappy_compress(pixels, PIXEL_BYTES, packed, &packed_bytes), SNAPPY_OK);
	put_le(kind, 4);
	put_le(WIDTH, 4);
	put_le(HEIGHT, 4);
	put_le(frame, 8);
	put_le(packed_bytes, 8);
	memcpy(file + file_bytes, packed, packed_bytes);
	file_bytes += packed_bytes;
}

static void fill_color(uint8_t *pixels, uint64_t frame)
{
	for (int i = 0; i < PIXEL_BYTES; i++)
		pixels[i] = (uint8_t)(i * 7 + frame * 31);
}

static void fill_depth(float *depth, uint64_t frame)
{
	for (int i = 0; i < WIDTH * HEIGHT; i++)
		depth[i] = (float)i / (float)(frame + 20);
}

static void make_file(void)
{
	uint8_t color[PIXEL_BYTES];
	float depth[WIDTH * HEIGHT];

	file_bytes = 0;
	memcpy(file, REF_MAGIC_WHOLE, 8);
	file_bytes = 8;
	for (int i = 0; i < N_FRAMES; i++) { /* frames 0, 3, 6, 9 as --ref-every 3 makes them */
		fill_color(color, (uint64_t)i * 3);
		fill_depth(depth, (uint64_t)i * 3);
		put_record(REF_COLOR, (uint64_t)i * 3, color);
		record_end[i * 2] = file_bytes;
		put_record(REF_DEPTH, (uint64_t)i * 3, depth);
		record_end[i * 2 + 1] = file_bytes;
	}
}

static void write_file(size_t bytes)
{
	FILE *f = fopen(path, "wb");

	ck_assert_ptr_nonnull(f);
	ck_assert_uint_eq(fwrite(file, 1, bytes, f), bytes);
	ck_assert_int_eq(fclose(f), 0);
}

START_TEST(test_reads_back_what_was_written)
{
	struct ref_file ref = { 0 };
	uint8_t color[PIXEL_BYTES];
	float depth[WIDTH * HEIGHT];

	make_file();
	write_file(file_bytes);
	ck_assert_int_eq(ref_open(&ref, path), 0);
	ck_assert_uint_eq(ref.n_entries, N_FRAMES * 2);
	for (uint64_t frame = 0; frame < 12; frame++) {
		const struct ref_entry *c = ref_find(&ref, REF_COLOR, frame), *d = ref_find(&ref, REF_DEPTH, frame);
		void *got;

		if (frame % 3) {
			ck_assert_ptr_null(c);
			ck_assert_ptr_null(d);
			continue;
		}
		fill_color(color, frame);
		fill_depth(depth, frame);
		ck_assert_uint_eq(c->width, WIDTH);
		ck_assert_uint_eq(c->height, HEIGHT);
		ck_assert_int_eq(ref_read(&ref, c, &got), 0);
		ck_assert_mem_eq(got, color, PIXEL_BYTES);
		free(got);
		ck_assert_int_eq(ref_read(&ref, d, &got), 0);
		ck_assert_mem_eq(got, depth, PIXEL_BYTES);
		free(got);
	}
	ref_close(&ref);
	ck_assert_ptr_null(ref.entries);
}
END_TEST

/* A file with another signature is refused, whatever follows. */
START_TEST(test_other_files)
{
	for (size_t at = 0; at < 8; at++) {
		struct ref_file ref = { 0 };

		make_file();
		file[at] ^= 1;
		write_file(file_bytes);
		ck_assert_int_eq(ref_open(&ref, path), ERR_INPUT);
	}
}
END_TEST

START_TEST(test_cut_at_any_byte_keeps_whole_records)
{
	make_file();
	for (size_t cut = 0; cut <= file_bytes; cut++) {
		struct ref_file ref = { 0 };
		size_t whole = 0;

		write_file(cut);
		if (cut < 8) {
			ck_assert_int_eq(ref_open(&ref, path), ERR_INPUT);
			continue;
		}
		while (whole < N_FRAMES * 2 && record_end[whole] <= cut)
			whole++;
		ck_assert_int_eq(ref_open(&ref, path), 0);
		ck_assert_uint_eq(ref.n_entries, whole);
		ck_assert_int_eq(ref.is_cut, cut != (whole ? record_end[whole - 1] : 8));
		ref_close(&ref);
	}
}
END_TEST

/* Write like the recorder: frames from `first` on, of two sizes and both kinds. at: receives the offset of each
 * frame's colours */
static void make_changes(uint64_t n_frames, size_t at[])
{
	struct ref_last last[2] = { 0 };
	uint32_t pixels[2][WIDTH * HEIGHT], before[2][WIDTH * HEIGHT];
	uint8_t planes[PIXEL_BYTES], record[512];

	memcpy(file, REF_MAGIC, 8);
	file_bytes = 8;
	ck_assert_uint_le(ref_pack_room(WIDTH * HEIGHT), sizeof(record));
	for (uint64_t frame = 0; frame < n_frames; frame++) {
		at[frame] = file_bytes;
		fill_color((uint8_t *)pixels[0], frame);
		fill_depth((float *)pixels[1], frame);
		for (unsigned k = 0; k < 2; k++) {
			const struct ref_head head = { k ? REF_DEPTH : REF_COLOR, frame % 10 == 9 ? HEIGHT : WIDTH,
				                       frame % 10 == 9 ? WIDTH : HEIGHT, frame, 0 };
			const size_t bytes = ref_pack(&last[k], &head, file_bytes, pixels[k], before[k], planes, record);

			ck_assert_uint_gt(bytes, sizeof(head));
			memcpy(file + file_bytes, record, bytes);
			file_bytes += bytes;
		}
		memcpy(before, pixels, sizeof(before));
	}
}

static void check_frames(const struct ref_file *ref, uint64_t first, uint64_t n)
{
	uint8_t color[PIXEL_BYTES];
	float depth[WIDTH * HEIGHT];
	void *got;

	for (uint64_t frame = 0; frame < n; frame++) {
		const struct ref_entry *c = ref_find(ref, REF_COLOR, frame), *d = ref_find(ref, REF_DEPTH, frame);

		fill_color(color, first + frame);
		fill_depth(depth, first + frame);
		ck_assert_int_eq(ref_read(ref, c, &got), 0);
		ck_assert_mem_eq(got, color, PIXEL_BYTES);
		free(got);
		ck_assert_int_eq(ref_read(ref, d, &got), 0);
		ck_assert_mem_eq(got, depth, PIXEL_BYTES);
		free(got);
	}
}

START_TEST(test_changes_read_back)
{
	char copy[] = "/tmp/relume-test-ref-copy-XXXXXX";
	struct ref_file ref = { 0 };
	size_t at[48], changed = 0;

	make_changes(48, at);
	write_file(file_bytes);
	ck_assert_int_eq(ref_open(&ref, path), 0);
	ck_assert_uint_eq(ref.n_entries, 96);
	for (size_t i = 0; i < ref.n_entries; i++)
		changed += ref.entries[i].is_changed;
	ck_assert_uint_gt(changed, 20);
	ck_assert_uint_lt(changed, 90);
	check_frames(&ref, 0, 48);

	ck_assert_int_ge(close(mkstemp(copy)), 0);
	ck_assert_int_eq(ref_copy(&ref, 5, 30, copy), 0);
	ref_close(&ref);
	ck_assert_int_eq(ref_open(&ref, copy), 0);
	ck_assert_uint_eq(ref.n_entries, 52);
	check_frames(&ref, 5, 26);
	ref_close(&ref);
	unlink(copy);
}
END_TEST

/* A short read is continued. */
START_TEST(test_reads_in_parts)
{
	struct ref_file ref = { 0 };
	size_t at[10];

	make_changes(10, at);
	write_file(file_bytes);
	most_at_once = 7;
	ck_assert_int_eq(ref_open(&ref, path), 0);
	ck_assert_uint_eq(ref.n_entries, 20);
	check_frames(&ref, 0, 10);
	ref_close(&ref);
}
END_TEST

START_TEST(test_bases_that_lie_are_refused)
{
	struct ref_file ref = { 0 };
	size_t at[3];
	uint64_t bases[4], kept;
	void *got = NULL;

	make_changes(3, at);
	memcpy(&kept, file + at[2] + sizeof(struct ref_head), sizeof(kept));
	ck_assert_uint_eq(kept, at[1]);
	bases[0] = at[2];       /* the record itself */
	bases[1] = at[1] + 1;   /* no record starts there */
	bases[2] = UINT64_MAX;
	bases[3] = at[0] + sizeof(struct ref_head) + file[at[0] + 20]; /* the first depth record */
	for (unsigned i = 0; i < 4; i++) {
		memcpy(file + at[2] + sizeof(struct ref_head), &bases[i], sizeof(kept));
		write_file(file_bytes);
		ck_assert_int_eq(ref_open(&ref, path), 0);
		ck_assert_int_eq(ref_read(&ref, ref_find(&ref, REF_COLOR, 2), &got), ERR_INPUT);
		ck_assert_ptr_null(got);
		ref_close(&ref);
	}
	memcpy(file + at[2] + sizeof(struct ref_head), &kept, sizeof(kept));
	file[at[0] + 1] = 1; /* the first record as a change: it has no predecessor */
	write_file(file_bytes);
	ck_assert_int_eq(ref_open(&ref, path), 0);
	ck_assert_int_eq(ref_read(&ref, ref_find(&ref, REF_COLOR, 2), &got), ERR_INPUT);
	ref_close(&ref);
}
END_TEST

START_TEST(test_lies_are_refused)
{
	struct ref_file ref = { 0 };
	void *got = NULL;

	ck_assert_int_eq(ref_open(&ref, "/nonexistent/x.ref"), ERR_INPUT);
	ck_assert_int_eq(ref_open(&ref, "/tmp"), ERR_INPUT);

	make_file();
	file[8] = 9; /* a kind that does not exist */
	write_file(file_bytes);
	ck_assert_int_eq(ref_open(&ref, path), ERR_INPUT);

	make_file();
	file[8 + 4] = WIDTH + 1; /* a size that does not match the block */
	write_file(file_bytes);
	ck_assert_int_eq(ref_open(&ref, path), 0);
	ck_assert_int_eq(ref_read(&ref, &ref.entries[0], &got), ERR_INPUT);
	ck_assert_ptr_null(got);
	ref_close(&ref);

	make_file();
	memset(file + 8 + 28 + 1, 0xFF, 8); /* a block that is not Snappy */
	write_file(file_bytes);
	ck_assert_int_eq(ref_open(&ref, path), 0);
	ck_assert_int_eq(ref_read(&ref, &ref.entries[0], &got), ERR_INPUT);
	ref_close(&ref);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("ref");
	int failed, fd = mkstemp(path);

	if (fd < 0)
		return 1;
	close(fd);
	tcase_add_test(tcase, test_reads_back_what_was_written);
	tcase_add_test(tcase, test_other_files);
	tcase_add_test(tcase, test_cut_at_any_byte_keeps_whole_records);
	tcase_add_test(tcase, test_changes_read_back);
	tcase_add_test(tcase, test_reads_in_parts);
	tcase_add_test(tcase, test_bases_that_lie_are_refused);
	tcase_add_test(tcase, test_lies_are_refused);
	failed = run_case(tcase, "ref");
	unlink(path);
	return failed != 0;
}
