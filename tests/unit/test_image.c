/*
 * struct image and its OpenEXR form: data read equals data written, writing twice gives the same bytes, and errors
 * leave no partial file.
 */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"
#include "tests/case.h"
#include "tests/said.h"
#include "tracer/image/exr_pack.h"
#include "tracer/image/image.h"

static char folder[] = "/tmp/test_image.XXXXXX";

static const char *in_folder(const char *name)
{
	static char path[256];

	snprintf(path, sizeof(path), "%s/%s", folder, name);
	return path;
}

static float noise(uint32_t *seed)
{
	*seed = *seed * 1664525u + 1013904223u;
	return (float)(*seed >> 8) / 16777216.0f;
}

static struct image make_image(uint32_t width, uint32_t height)
{
	struct image img = { .width = width, .height = height };
	float *half = image_add_channel(&img, "gl.R", 0), *full = image_add_channel(&img, "Z", 1);
	uint32_t seed = 1;

	for (size_t i = 0; i < (size_t)width * height; i++) {
		half[i] = (float)(i % 2048) / 1024; /* representable as half */
		full[i] = noise(&seed);
	}
	image_set_attribute(&img, "relume:frame", "%d", 17);
	image_set_attribute(&img, "worldToCamera", "1 0 0 0 0 1 0 0 0 0 -1 0 0.5 0 0 1");
	return img;
}

static long file_size(const char *path)
{
	struct stat status;

	return stat(path, &status) == 0 ? (long)status.st_size : -1;
}

static char *file_bytes(const char *path, long *size)
{
	FILE *f = fopen(path, "rb");
	char *bytes;

	*size = file_size(path);
	ck_assert_ptr_nonnull(f);
	bytes = malloc((size_t)*size);
	ck_assert_uint_eq(fread(bytes, 1, (size_t)*size, f), (size_t)*size);
	fclose(f);
	return bytes;
}

START_TEST(test_round_trip)
{
	struct image img = make_image(61, 37), back = { 0 };

	ck_assert_int_eq(image_write_exr(&img, in_folder("round.exr")), 0);
	ck_assert_int_eq(image_read_exr(&back, in_folder("round.exr")), 0);
	ck_assert_uint_eq(back.width, 61);
	ck_assert_uint_eq(back.height, 37);
	ck_assert_uint_eq(back.n_channels, 2);
	for (size_t i = 0; i < img.n_channels; i++)
		ck_assert_mem_eq(image_channel(&back, img.channels[i].name), img.channels[i].values, 61 * 37 * sizeof(float));
	ck_assert_str_eq(image_attribute(&back, "relume:frame"), "17");
	ck_assert_str_eq(image_attribute(&back, "worldToCamera"), "1 0 0 0 0 1 0 0 0 0 -1 0 0.5 0 0 1");
	image_free(&img);
	image_free(&back);
	ck_assert_ptr_null(img.channels);
}
END_TEST

/*
 * Rows from one value to a full chunk, with noise of every kind, so that some sizes are near the border between
 * compressed and raw.
 */
START_TEST(test_every_small_size)
{
	for (uint32_t width = 1; width < 40; width++)
		for (uint32_t height = 1; height < 4; height++) {
			struct image img = { .width = width, .height = height }, back = { 0 };
			float *full = image_add_channel(&img, "Z", 1);
			uint32_t seed = width;

			for (uint32_t i = 0; i < width * height; i++)
				full[i] = i % 3 ? noise(&seed) : 1.0f;
			ck_assert_int_eq(image_write_exr(&img, in_folder("small.exr")), 0);
			ck_assert_int_eq(image_read_exr(&back, in_folder("small.exr")), 0);
			ck_assert_mem_eq(image_channel(&back, "Z"), full, width * height * sizeof(float));
			image_free(&img);
			image_free(&back);
		}
}
END_TEST

START_TEST(test_same_bytes)
{
	struct image img = make_image(100, 50);
	long n1, n2;
	char *a, *b;

	ck_assert_int_eq(image_write_exr(&img, in_folder("a.exr")), 0);
	ck_assert_int_eq(image_write_exr(&img, in_folder("b.exr")), 0);
	a = file_bytes(in_folder("a.exr"), &n1);
	b = file_bytes(in_folder("b.exr"), &n2);
	ck_assert_int_eq(n1, n2);
	ck_assert_mem_eq(a, b, (size_t)n1);
	free(a);
	free(b);
	image_free(&img);
}
END_TEST

/* Fill the stack that the next call uses. */
__attribute__((noinline)) static void dirty_stack(uint16_t value)
{
	volatile uint16_t stack[200000];

	for (size_t i = 0; i < sizeof(stack) / sizeof(stack[0]); i++)
		stack[i] = value;
}

/* Earlier contents of memory must not affect any byte of a chunk. */
START_TEST(test_dirty_stack)
{
	const uint32_t width = 640;
	struct image img = make_image(width, 16);
	struct exr_plane planes[] = { { NULL, img.channels[0].values, 0 }, { NULL, img.channels[1].values, 1 } };
	struct exr_rows rows = { planes, 2, width, 0, 16 };
	struct exr_packer packer = { 0 };
	uint32_t seed = 1;
	uint8_t *first;
	size_t n;

	for (size_t i = 0; i < (size_t)width * 16; i++) /* few values: matches are found at every distance */
		img.channels[1].values[i] = roundf(4 * noise(&seed));
	ck_assert_int_eq(exr_pack(&packer, &rows), 0);
	n = packer.n_packed;
	first = malloc(n);
	memcpy(first, packer.packed, n);
	for (uint16_t value = 0; value < 256; value++) {
		dirty_stack(value);
		ck_assert_int_eq(exr_pack(&packer, &rows), 0);
		ck_assert_uint_eq(packer.n_packed, n);
		ck_assert_mem_eq(packer.packed, first, n);
	}
	free(first);
	exr_packer_free(&packer);
	image_free(&img);
}
END_TEST

/* Rows delivered in bands and compressed by several threads give the same file as the whole picture. */
START_TEST(test_bands)
{
	const uint32_t width = 50, height = 403, ends[] = { 7, 9, 41, 105, 112, 115, 290, 403 };
	struct image img = make_image(width, height), band = { .width = width, .height = height, .packers = 3 };
	uint16_t *halves = image_add_halves(&img, "R");
	long n1, n2;
	char *a, *b;

	for (size_t i = 0; i < (size_t)width * height; i++) { /* some rows change, others repeat */
		halves[i] = (uint16_t)(i < (size_t)width * 200 ? 14336 : i % 7);
		img.channels[0].values[i] = img.channels[1].values[i] =
			i < (size_t)width * 100 || i > (size_t)width * 150 ? 1.0f : (float)(i % 5);
	}
	image_add_channel(&band, "gl.R", 0);
	image_add_channel(&band, "Z", 1);
	image_add_halves(&band, "R");
	for (size_t k = 0; k < sizeof(ends) / sizeof(ends[0]); k++) {
		const uint32_t first = k ? ends[k - 1] : 0;
		const void *planes[] = { img.channels[0].values + first * width, img.channels[1].values + first * width,
			                 halves + first * width };

		ck_assert_int_eq(image_take_rows(&band, planes, ends[k] - first), 0);
	}
	for (size_t i = 0; i < img.n_attributes; i++)
		image_set_attribute(&band, img.attributes[i].name, "%s", img.attributes[i].text);
	ck_assert_int_eq(image_write_exr(&img, in_folder("whole.exr")), 0);
	ck_assert_int_eq(image_write_exr(&band, in_folder("bands.exr")), 0);
	a = file_bytes(in_folder("whole.exr"), &n1);
	b = file_bytes(in_folder("bands.exr"), &n2);
	ck_assert_int_eq(n1, n2);
	ck_assert_mem_eq(a, b, (size_t)n1);
	free(a);
	free(b);
	image_free(&img);
	image_free(&band);
}
END_TEST

START_TEST(test_half_rounds_to_nearest_even)
{
	struct image img = { .width = 3, .height = 1 }, back = { 0 };
	float *v = image_add_channel(&img, "R", 0);

	v[0] = 1 + 1 / 2048.0f; /* halfway: to even, down */
	v[1] = 1 + 3 / 2048.0f; /* halfway: to even, up */
	v[2] = INFINITY;
	ck_assert_int_eq(image_write_exr(&img, in_folder("half.exr")), 0);
	ck_assert_int_eq(image_read_exr(&back, in_folder("half.exr")), 0);
	v = image_channel(&back, "R");
	ck_assert_float_eq(v[0], 1);
	ck_assert_float_eq(v[1], 1 + 2 / 1024.0f);
	ck_assert(isinf(v[2]));
	image_free(&img);
	image_free(&back);
}
END_TEST

/* A truncated file is refused or, if all pixels are present, read; never a crash or a partly filled image. */
START_TEST(test_cut_file)
{
	struct image img = make_image(40, 40);
	long size;
	char *bytes;

	ck_assert_int_eq(image_write_exr(&img, in_folder("whole.exr")), 0);
	bytes = file_bytes(in_folder("whole.exr"), &size);
	for (long n = 0; n < size; n += 1 + size / 97) {
		struct image back = { 0 };
		FILE *f = fopen(in_folder("cut.exr"), "wb");

		fwrite(bytes, 1, (size_t)n, f);
		fclose(f);
		ck_assert_int_eq(image_read_exr(&back, in_folder("cut.exr")), ERR_INPUT);
		ck_assert_ptr_null(back.channels);
	}
	free(bytes);
	image_free(&img);
}
END_TEST

/* A picture too large for memory is refused with a message, and keeps its existing channels. */
START_TEST(test_no_memory)
{
	struct image img = { .width = 0x7fffffff, .height = 0x7fffffff };
	struct said said = said_begin();
	const int none = !image_add_channel(&img, "R", 1) && !image_add_halves(&img, "G");
	char text[512];

	said_end(&said, text, sizeof(text));
	ck_assert(none && img.n_channels == 0);
	ck_assert_msg(strstr(text, "out of memory for channel R of 2147483647 x 2147483647 pixels"), "%s", text);
	image_free(&img);
}
END_TEST

/* A disk that is full after `most` bytes: one line with the reason, and no file. */
START_TEST(test_full_disk)
{
	static const rlim_t most[] = { 500, 20000 }; /* the message itself also counts */

	signal(SIGXFSZ, SIG_IGN);
	for (int i = 0; i < 2; i++) {
		const struct rlimit limit = { most[i], RLIM_INFINITY }, none = { RLIM_INFINITY, RLIM_INFINITY };
		struct image img = make_image(200, 200);
		struct said said = said_begin();
		char text[512], *end;
		int err;

		setrlimit(RLIMIT_FSIZE, &limit);
		err = image_write_exr(&img, in_folder("full.exr"));
		setrlimit(RLIMIT_FSIZE, &none);
		said_end(&said, text, sizeof(text));
		ck_assert_int_eq(err, ERR_SYSTEM);
		end = strchr(text, '\n');
		ck_assert_msg(end && !end[1] && strstr(text, "full.exr: cannot be written: "), "after %d bytes: %s",
		              (int)most[i], text);
		ck_assert_int_eq(file_size(in_folder("full.exr")), -1);
		image_free(&img);
	}
}
END_TEST

START_TEST(test_refuses)
{
	struct image img = make_image(4, 4), back = { 0 };

	ck_assert_int_eq(image_read_exr(&back, in_folder("missing.exr")), ERR_INPUT);
	ck_assert_int_eq(image_read_exr(&back, folder), ERR_INPUT);
	ck_assert_int_eq(image_write_exr(&img, in_folder("no/such/folder.exr")), ERR_SYSTEM);
	ck_assert_int_eq(image_write_exr(&img, folder), ERR_SYSTEM);
	image_free(&img);
}
END_TEST

START_TEST(test_encoding)
{
	for (int code = 0; code < 256; code++) {
		float x = (float)code / 255;

		ck_assert_float_eq_tol(image_display_from_linear(image_linear_from_display(x)), x, 1e-6f);
	}
	ck_assert_float_eq_tol(image_linear_from_display(0.5f), 0.21404114f, 1e-6f);
	ck_assert_float_eq_tol(image_linear_from_display(-0.5f), -0.21404114f, 1e-6f);
	ck_assert_float_eq(image_linear_from_display(1), 1);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("image");
	char command[64];
	int failed;

	if (!mkdtemp(folder))
		return 1;
	tcase_add_test(tests, test_round_trip);
	tcase_add_test(tests, test_every_small_size);
	tcase_add_test(tests, test_same_bytes);
	tcase_add_test(tests, test_dirty_stack);
	tcase_add_test(tests, test_bands);
	tcase_add_test(tests, test_half_rounds_to_nearest_even);
	tcase_add_test(tests, test_cut_file);
	tcase_add_test(tests, test_no_memory);
	tcase_add_test(tests, test_full_disk);
	tcase_add_test(tests, test_refuses);
	tcase_add_test(tests, test_encoding);
	failed = run_case(tests, "image");
	snprintf(command, sizeof(command), "rm -rf %s", folder);
	return system(command) != 0 || failed != 0;
}
