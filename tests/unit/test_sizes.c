/* Sizes of data that arguments point to: pixel rectangles under all unpack state, evaluator maps, lists, vectors. */
#include <GL/gl.h>
#include <GL/glext.h>
#include <limits.h>

#include "capture/format/sizes.h"
#include "tests/case.h"

static const struct pixel_layout initial = { .alignment = 4 };

START_TEST(test_rows_are_padded_but_for_the_last)
{
	struct pixel_layout packed = { .alignment = 1 };

	ck_assert_int_eq(image_bytes(&packed, &(struct pixel_box){ 2, GL_RGB, GL_UNSIGNED_BYTE, 5, 3, 1 }), 45);
	ck_assert_int_eq(image_bytes(&initial, &(struct pixel_box){ 2, GL_RGB, GL_UNSIGNED_BYTE, 5, 3, 1 }), 16 + 16 + 15);
	ck_assert_int_eq(image_bytes(&initial, &(struct pixel_box){ 1, GL_LUMINANCE, GL_UNSIGNED_BYTE, 7, 1, 1 }), 7);
	ck_assert_int_eq(image_bytes(&initial, &(struct pixel_box){ 2, GL_RGBA, GL_FLOAT, 2, 2, 1 }), 64);
}
END_TEST

START_TEST(test_bitmaps_count_bits)
{
	ck_assert_int_eq(image_bytes(&initial, &(struct pixel_box){ 2, GL_COLOR_INDEX, GL_BITMAP, 32, 32, 1 }), 128);
	ck_assert_int_eq(image_bytes(&initial, &(struct pixel_box){ 2, GL_COLOR_INDEX, GL_BITMAP, 9, 2, 1 }), 4 + 2);
	ck_assert_int_eq(image_bytes(&(struct pixel_layout){ .alignment = 1, .skip_pixels = 7 },
	                             &(struct pixel_box){ 2, GL_COLOR_INDEX, GL_BITMAP, 2, 1, 1 }),
	                 2);
}
END_TEST

START_TEST(test_layout_reaches_where_gl_reads)
{
	struct pixel_layout sub = { .alignment = 1, .row_length = 10, .skip_rows = 2, .skip_pixels = 3 };

	ck_assert_int_eq(image_bytes(&sub, &(struct pixel_box){ 2, GL_RGBA, GL_UNSIGNED_BYTE, 4, 3, 1 }),
	                 (2 + 2) * 40 + (3 + 4) * 4);
	sub.image_height = 6;
	sub.skip_images = 1;
	ck_assert_int_eq(image_bytes(&sub, &(struct pixel_box){ 3, GL_RGBA, GL_UNSIGNED_BYTE, 4, 3, 2 }),
	                 (6 + 6 + 2 + 2) * 40 + (3 + 4) * 4);
	ck_assert_int_eq(image_bytes(&sub, &(struct pixel_box){ 2, GL_RGBA, GL_UNSIGNED_BYTE, 4, 3, 1 }),
	                 (2 + 2) * 40 + (3 + 4) * 4);
}
END_TEST

START_TEST(test_packed_pixels)
{
	ck_assert_int_eq(image_pixel_bytes(GL_RGB, GL_UNSIGNED_SHORT_5_6_5), 2);
	ck_assert_int_eq(image_pixel_bytes(GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV), 4);
	ck_assert_int_eq(image_pixel_bytes(GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8), 4);
	ck_assert_int_eq(image_pixel_bytes(GL_LUMINANCE_ALPHA, GL_UNSIGNED_SHORT), 4);
}
END_TEST

START_TEST(test_nonsense_is_nothing)
{
	ck_assert_int_eq(image_bytes(&initial, &(struct pixel_box){ 2, GL_RGB, GL_UNSIGNED_BYTE, -1, 3, 1 }), 0);
	ck_assert_int_eq(image_bytes(&initial, &(struct pixel_box){ 2, GL_RGB, GL_UNSIGNED_BYTE, 3, 0, 1 }), 0);
	ck_assert_int_eq(image_bytes(&initial, &(struct pixel_box){ 2, 0xFFFF, GL_UNSIGNED_BYTE, 3, 3, 1 }), 0);
	ck_assert_int_eq(image_bytes(&initial, &(struct pixel_box){ 2, GL_RGB, 0xFFFF, 3, 3, 1 }), 0);
	ck_assert_int_eq(
		image_bytes(&(struct pixel_layout){ 0 }, &(struct pixel_box){ 2, GL_RGB, GL_UNSIGNED_BYTE, 3, 3, 1 }),
		0);
	ck_assert_int_eq(call_lists_bytes(-3, GL_INT), 0);
	ck_assert_int_eq(call_lists_bytes(3, 0), 0);
	ck_assert_int_eq(map1_count(GL_MAP1_VERTEX_3, 2, 4), 0);
	ck_assert_int_eq(map1_count(0, 3, 4), 0);
}
END_TEST

/* Skips of two thousand million images, rows and pixels each exceed any memory. */
START_TEST(test_more_than_memory_is_nothing)
{
	const struct pixel_layout far = { .image_height = INT_MAX, .skip_images = INT_MAX, .alignment = 1 };
	const struct pixel_layout wide = {
		.row_length = INT_MAX, .skip_rows = INT_MAX, .skip_pixels = INT_MAX, .alignment = 1
	};

	ck_assert_int_eq(image_bytes(&far, &(struct pixel_box){ 3, GL_RGBA, GL_UNSIGNED_BYTE, 4, 1, 1 }), 0);
	ck_assert_int_eq(image_bytes(&far, &(struct pixel_box){ 3, GL_RGBA, GL_UNSIGNED_BYTE, INT_MAX, 1, INT_MAX }), 0);
	ck_assert_int_eq(image_bytes(&wide, &(struct pixel_box){ 2, GL_RGBA, GL_FLOAT, 1, 1, 1 }), 0);
	ck_assert_int_eq(
		image_bytes(&initial, &(struct pixel_box){ 3, GL_RGBA, GL_UNSIGNED_BYTE, INT_MAX, INT_MAX, INT_MAX }),
		0);
	ck_assert_int_eq(map2_count(GL_MAP2_VERTEX_4, INT_MAX, INT_MAX, INT_MAX, INT_MAX), 2LL * (INT_MAX - 1) * INT_MAX + 4);
}
END_TEST

START_TEST(test_lists_maps_and_vectors)
{
	ck_assert_int_eq(call_lists_bytes(5, GL_3_BYTES), 15);
	ck_assert_int_eq(call_lists_bytes(5, GL_UNSIGNED_SHORT), 10);
	ck_assert_int_eq(map1_count(GL_MAP1_VERTEX_3, 3, 4), 12);
	ck_assert_int_eq(map1_count(GL_MAP1_VERTEX_3, 5, 4), 3 * 5 + 3);
	ck_assert_int_eq(map2_count(GL_MAP2_VERTEX_4, 4, 3, 12, 2), 2 * 4 + 12 + 4);
	ck_assert_int_eq(count_of_pname(GL_POSITION), 4);
	ck_assert_int_eq(count_of_pname(GL_SPOT_DIRECTION), 3);
	ck_assert_int_eq(count_of_pname(GL_SHININESS), 1);
	ck_assert_int_eq(count_of_pname(GL_PROJECTION_MATRIX), 16);
	ck_assert_int_eq(clear_buffer_count(GL_COLOR), 4);
	ck_assert_int_eq(clear_buffer_count(GL_DEPTH), 1);
	ck_assert_int_eq(marker_bytes(0, "four"), 4);
	ck_assert_int_eq(marker_bytes(2, "four"), 2);
	ck_assert_int_eq(debug_text_bytes(-1, "four"), 4);
	ck_assert_int_eq(debug_text_bytes(0, "four"), 0);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("sizes");

	tcase_add_test(tcase, test_rows_are_padded_but_for_the_last);
	tcase_add_test(tcase, test_bitmaps_count_bits);
	tcase_add_test(tcase, test_layout_reaches_where_gl_reads);
	tcase_add_test(tcase, test_packed_pixels);
	tcase_add_test(tcase, test_nonsense_is_nothing);
	tcase_add_test(tcase, test_more_than_memory_is_nothing);
	tcase_add_test(tcase, test_lists_maps_and_vectors);
	return run_case(tcase, "sizes");
}
