/* Codes of display pictures (tracer/image/display.h): curve, dither, values above white. real/test_display covers
 * the files. */
#include <math.h>
#include <string.h>

#include "tests/alone.h"
#include "tracer/image/display.h"

enum { SIDE = 16 };

static uint8_t codes[SIDE * SIDE][3];

/* Codes of a picture with a single value. @return number of pixels brighter than white */
static uint64_t show(const struct display_options *options, const char *encoding, float value)
{
	struct image img = { .width = SIDE, .height = SIDE };
	struct display *display = NULL;
	uint64_t over = 12345;

	for (int c = 0; c < 3; c++) {
		float *plane = image_add_channel(&img, (const char[]){ "RGB"[c], 0 }, 0);

		for (int i = 0; i < SIDE * SIDE; i++)
			plane[i] = c == 1 ? value : 0;
	}
	image_set_attribute(&img, "relume:encoding", "%s", encoding);
	ck_assert_int_eq(display_create(options, &display), 0);
	ck_assert_int_eq(display_codes(display, &img, "", &codes[0][0], &over), 0);
	ck_assert_int_eq(display_codes(display, &img, "", &codes[0][0], NULL), 0);
	display_destroy(&display);
	image_free(&img);
	return over;
}

/* Each of 64 pixels has a threshold of its own, in steps of 0.9 / 64: in every 8 x 8 square, the pixels with
 * thresholds below the value are rounded up. */
START_TEST(test_dither)
{
	static const struct display_options options = { 0, 1, 0 };

	for (int step = -4; step <= 4; step++) {
		const float value = 0.5f + ldexpf((float)step, -11), code = 255 * value;
		int wanted = 0;

		show(&options, "display", value);
		for (int b = 0; b < 64; b++)
			wanted += floorf(code + 0.5f + 0.9f * (((float)b + 0.5f) / 64 - 0.5f)) > 127;
		for (int square = 0; square < 4; square++) {
			int up = 0;

			for (int i = 0; i < 64; i++) {
				const uint8_t *at = codes[(square / 2 * 8 + i / 8) * SIDE + square % 2 * 8 + i % 8];

				ck_assert(at[0] == 0 && at[2] == 0 && (at[1] == 127 || at[1] == 128));
				up += at[1] == 128;
			}
			ck_assert_msg(up == wanted, "%g: %d of 64 are rounded up, not %d", code, up, wanted);
		}
	}
	show(&options, "display", 128.0f / 255); /* exactly a code */
	for (int i = 0; i < SIDE * SIDE; i++)
		ck_assert_uint_eq(codes[i][1], 128);
}
END_TEST

/* The light shown as white, and the number of brighter pixels, by encoding, exposure and white. */
START_TEST(test_white)
{
	static const struct { const char *encoding; float value, exposure, white; int code; uint64_t over; } rows[] = {
		{ "linear", 0.5f, 0, 1, 188, 0 }, { "linear", 1, 0, 1, 255, 0 }, { "linear", 1.01f, 0, 1, 255, SIDE * SIDE },
		{ "linear", 0.25f, 1, 1, 188, 0 }, { "linear", 0.51f, 1, 1, 255, SIDE * SIDE }, { "linear", 2, -1, 1, 255, 0 },
		{ "linear", 3, 0, 4, 253, 0 }, { "linear", 4.01f, 0, 4, 255, SIDE * SIDE }, { "display", 0.5f, 0, 1, 128, 0 },
		{ "display", 1.01f, 0, 1, 255, SIDE * SIDE }, { "linear", -1, 0, 1, 0, 0 }, { "linear", NAN, 0, 1, 0, 0 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		const struct display_options options = { rows[i].exposure, rows[i].white, 1 };

		ck_assert_msg(show(&options, rows[i].encoding, rows[i].value) == rows[i].over,
		              "row %zu: wrong number of pixels brighter than white", i);
		ck_assert_msg(codes[7][1] == rows[i].code, "row %zu: code %u, not %d", i, codes[7][1], rows[i].code);
	}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("display");

	tcase_add_test(tcase, test_dither);
	tcase_add_test(tcase, test_white);
	return run_alone(tcase, "display");
}
