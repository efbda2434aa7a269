/* Sets of frames (diff/pictures/set.h): which files of a folder or pattern are frames, the references that a trace
 * names, the contents of a record. */
#include <fcntl.h>
#include <snappy-c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"
#include "capture/format/ref_pack.h"
#include "diff/pictures/set.h"
#include "diff/report/pictures.h"
#include "diff/score/picture.h"
#include "tests/alone.h"
#include "tests/said.h"

/* The frames of a set must be these, in order. */
static void check_set(const char *where, size_t n, const uint64_t frames[])
{
	struct set set = { 0 };

	ck_assert_msg(set_open(where, &set) == 0, "%s: cannot be opened", where);
	ck_assert_msg(set.n_entries == n, "%s: %zu frames, not %zu", where, set.n_entries, n);
	for (size_t i = 0; i < n; i++) {
		ck_assert_msg(set.entries[i].frame == frames[i], "%s: frame %zu is %d, not %d", where, i,
		              (int)set.entries[i].frame, (int)frames[i]);
		ck_assert_ptr_eq(set_find(&set, frames[i]), &set.entries[i]);
	}
	ck_assert_ptr_null(set_find(&set, 12345));
	set_free(&set);
}

static void check_refused(const char *where, int err, const char *words)
{
	struct set set = { 0 };
	struct said said = said_begin();
	const int got = set_open(where, &set);
	char text[1024];

	said_end(&said, text, sizeof(text));
	ck_assert_msg(got == err, "%s: %d, not %d", where, got, err);
	ck_assert_msg(strstr(text, words), "%s: %s", where, text);
	ck_assert_ptr_null(set.entries);
}

/* The last number in an image's name is its frame; hidden files and other files are ignored in folders, but not if a
 * pattern names them. */
START_TEST(test_folders)
{
	static const char *const names[] = { "a.0007.png",     "a2.0010.EXR", "b3.jpeg",       ".a.0001.png",
		                             "notes.0002.txt", "0004",        "none.png",      "x.0020.txt",
		                             "x.0021.txt",     ".x.0022.txt", "x.0023.txt.bak" };

	ck_assert_int_eq(mkdir("d", 0777), 0);
	ck_assert_int_eq(chdir("d"), 0);
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		said_write_file(names[i], "");
	ck_assert_int_eq(chdir(".."), 0);
	check_set("d", 3, (const uint64_t[]){ 3, 7, 10 });
	check_set("d/", 3, (const uint64_t[]){ 3, 7, 10 });
	check_set("d/x.####.txt", 2, (const uint64_t[]){ 20, 21 });
	check_set("d/a.####.png", 1, (const uint64_t[]){ 7 });
	check_refused("d/y.####.png", ERR_INPUT, "d/y.####.png: there is no numbered image");
	check_refused("no", ERR_INPUT, "No such file");
	check_refused("no/x.####.png", ERR_INPUT, "no/: No such file");
	check_refused("d#/x.##.png", ERR_USAGE, "must be in the file's name");
	said_write_file("d/b.007.png", "");
	check_refused("d", ERR_USAGE, "two images of frame 7");
}
END_TEST

/* A single image is a set, whatever its number. */
START_TEST(test_single)
{
	struct set set = { 0 };

	said_write_file("a.0012.png", "");
	said_write_file("b.PNG", "");
	ck_assert_int_eq(set_open("a.0012.png", &set), 0);
	ck_assert(set.is_single && set.n_entries == 1 && set.entries[0].frame == 12);
	set_free(&set);
	check_set("b.PNG", 1, (const uint64_t[]){ 0 });
}
END_TEST

enum { WIDTH = 3, HEIGHT = 2 };

static void put_record(FILE *out, enum ref_kind kind, uint64_t frame, const void *pixels)
{
	char packed[256];
	size_t n = sizeof(packed);

	ck_assert_int_eq(snappy_compress(pixels, 4 * WIDTH * HEIGHT, packed, &n), SNAPPY_OK);
	for (int i = 0; i < 5; i++) {
		const uint64_t head[5] = { kind, WIDTH, HEIGHT, frame, n };

		fwrite(&head[i], i < 3 ? 4 : 8, 1, out);
	}
	fwrite(packed, 1, n, out);
}

/* Frames 4 and 2; frame 4 has a depth. */
static void write_ref(const char *path)
{
	FILE *out = fopen(path, "wb");
	uint8_t color[4 * WIDTH * HEIGHT];
	float depth[WIDTH * HEIGHT];

	ck_assert_ptr_nonnull(out);
	fwrite(REF_MAGIC_WHOLE, 1, 8, out);
	for (int i = 0; i < 4 * WIDTH * HEIGHT; i++)
		color[i] = (uint8_t)(51 * (i % 6));
	for (int i = 0; i < WIDTH * HEIGHT; i++)
		depth[i] = 0.125f * (float)i;
	put_record(out, REF_COLOR, 4, color);
	put_record(out, REF_DEPTH, 4, depth);
	put_record(out, REF_COLOR, 2, color);
	fclose(out);
}

/* NAME.ref beside a trace of any name; its hash is stored. */
START_TEST(test_traces)
{
	static const char *const traces[] = { "a.trace", "b.c.trace", "plain", "./d.x/trace" };
	static const char *const refs[] = { "a.ref", "b.c.ref", "plain.ref", "./d.x/trace.ref" };

	ck_assert_int_eq(mkdir("d.x", 0777), 0);
	for (size_t i = 0; i < 4; i++) {
		struct set set = { 0 };

		said_write_file(traces[i], "at");
		write_ref(refs[i]);
		ck_assert_int_eq(set_open(traces[i], &set), 0);
		ck_assert_str_eq(set.name, refs[i]);
		ck_assert_str_eq(set.trace, traces[i]);
		ck_assert_uint_eq(strlen(set.trace_hash), 32);
		ck_assert_uint_eq(set.n_entries, 2);
		set_free(&set);
		check_set(refs[i], 2, (const uint64_t[]){ 2, 4 });
	}
	said_write_file("alone.trace", "at");
	check_refused("alone.trace", ERR_INPUT, "no reference frames beside it (alone.ref)");
	said_write_file("bad.ref", "relume nothing");
	check_refused("bad.ref", ERR_INPUT, "not a file of reference frames");
}
END_TEST

/* A record is flipped, so that the top row comes first; depth is present if it was recorded. */
START_TEST(test_records)
{
	struct set set = { 0 };

	write_ref("a.ref");
	ck_assert_int_eq(set_open("a.ref", &set), 0);
	for (size_t i = 0; i < 2; i++) {
		struct image img = { 0 };

		ck_assert_int_eq(set_read(&set, &set.entries[i], &img), 0);
		ck_assert_uint_eq(img.width, WIDTH);
		ck_assert_uint_eq(img.height, HEIGHT);
		ck_assert_uint_eq(img.n_channels, 3 + i);
		for (size_t at = 0; at < WIDTH * HEIGHT; at++) {
			const size_t from = (HEIGHT - 1 - at / WIDTH) * WIDTH + at % WIDTH;

			for (size_t c = 0; c < 3; c++)
				ck_assert_float_eq_tol(image_channel(&img, (const char[]){ "RGB"[c], 0 })[at],
				                       (float)((4 * from + c) % 6) / 5, 1e-6f);
			if (i)
				ck_assert_float_eq(image_channel(&img, "gl.depth")[at], 0.125f * (float)from);
		}
		image_free(&img);
	}
	set_free(&set);
}
END_TEST

/* The layer compared with a reference: a requested one, else OpenGL's picture, else the beauty. */
START_TEST(test_reference_layers)
{
	static const char *const asked[] = { NULL, NULL, "albedo", "none" };
	static const int codes[] = { 51, 102, 153, 51 };

	for (int i = 0; i < 4; i++) {
		struct image img = { .width = 2, .height = 1 };
		struct score_picture picture = { 0 };

		for (int c = 0; c < 9; c++) {
			char name[16];
			float *plane;

			snprintf(name, sizeof(name), "%s%c", c < 3 ? "gl." : c < 6 ? "" : "albedo.", "RGB"[c % 3]);
			plane = i == 1 && c < 3 ? NULL : image_add_channel(&img, name, 1);
			for (int k = 0; plane && k < 2; k++)
				plane[k] = (float)(c < 3 ? 51 : c < 6 ? 102 : 153) / 255;
		}
		image_set_attribute(&img, "relume:encoding", "display");
		ck_assert_int_eq(picture_take_reference(&img, asked[i], &picture), 0);
		ck_assert_msg(picture.rgb[0] == codes[i], "asked for %s: %d, not %d", asked[i] ? asked[i] : "none",
		              picture.rgb[0], codes[i]);
		score_picture_free(&picture);
		image_free(&img);
	}
}
END_TEST

/* Effects that contribute nothing have no picture on the page; other layers always have one. */
START_TEST(test_effect_layers)
{
	for (int shows = 0; shows < 2; shows++) {
		struct picture_frame frame = { .image = { .width = 2, .height = 2 } };
		uint32_t width, height;
		uint8_t *rgb;

		for (int c = 0; c < 9; c++) {
			char name[16];
			float *plane;

			snprintf(name, sizeof(name), "%s%c", c < 3 ? "shadow." : c < 6 ? "" : "gl.", "RGB"[c % 3]);
			plane = image_add_channel(&frame.image, name, 1);
			for (int k = 0; k < 4; k++)
				plane[k] = c == 1 && k == 3 && shows ? 0.25f : 1;
		}
		ck_assert_int_eq(picture_make(&frame, PICTURE_SHADOW, &rgb, &width, &height), 0);
		ck_assert_msg(!rgb == !shows, "a shadow that %s", shows ? "shows has no picture" : "shows nothing has one");
		ck_assert(!rgb || (rgb[0] == 255 && rgb[10] < 255 && rgb[9] == 255));
		free(rgb);
		ck_assert_int_eq(picture_make(&frame, PICTURE_BEAUTY, &rgb, &width, &height), 0);
		ck_assert(rgb && width == 2 && height == 2);
		free(rgb);
		image_free(&frame.image);
	}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("set");

	tcase_add_checked_fixture(tcase, alone_enter, NULL);
	tcase_add_test(tcase, test_folders);
	tcase_add_test(tcase, test_single);
	tcase_add_test(tcase, test_traces);
	tcase_add_test(tcase, test_records);
	tcase_add_test(tcase, test_reference_layers);
	tcase_add_test(tcase, test_effect_layers);
	return run_alone_in_folders(tcase, "set");
}
