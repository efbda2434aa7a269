/* Merging the tricks found in several frames (look/study/tricks/tricks.h). */
#include "look/study/tricks/tricks.h"

#include <stdlib.h>
#include <string.h>

#include "look/study/light/relight.h"
#include "tests/case.h"

/*
 * A viewer who walks around a mirror sees its plane from the other side; content drawn beside it belongs to another
 * mirror.
 */
START_TEST(test_mirror_has_two_sides)
{
	struct tricks t = { .n = 0 };
	struct trick_found front = { .kind = TRICK_MIRROR, .plane = { 0, 0.6, 0.8, -2 } },
			   back = { .kind = TRICK_MIRROR, .plane = { 0, -0.6, -0.8, 2 } };
	struct trick_found other = { .kind = TRICK_MIRROR, .plane = { 0, 0.6, 0.8, 2 } };

	ck_assert_ptr_eq(tricks_note(&t, &front, 1), &t.found[0]);
	ck_assert_ptr_eq(tricks_note(&t, &back, 2), &t.found[0]);
	ck_assert_ptr_eq(tricks_note(&t, &other, 2), &t.found[1]);
	ck_assert_uint_eq(t.n, 2);
	ck_assert_uint_eq(t.found[0].votes, 2);
	ck_assert_uint_eq(t.found[0].frames, 2);
	for (int k = 0; k < 4; k++)
		ck_assert_double_eq_tol(t.found[0].plane[k], front.plane[k], 1e-12);
}
END_TEST

/* Planes of shadows are one-sided: light comes from one side. */
START_TEST(test_shadow_has_one_side)
{
	struct tricks t = { .n = 0 };
	struct trick_found above = { .kind = TRICK_PLANAR_SHADOW, .light = { 0, 5, 0, 1 }, .plane = { 0, 1, 0, 0 } },
			   below = above;

	below.plane[1] = -1;
	tricks_note(&t, &above, 1);
	tricks_note(&t, &below, 1);
	ck_assert_uint_eq(t.n, 2);
}
END_TEST

/* Shadows on several planes need one rule, since planes are not part of it; other shadows need another. */
START_TEST(test_one_rule_for_all_planes)
{
	struct tricks t = { .n = 0 };
	struct lightmaps maps = { .n_units = 0 };
	struct solved solved = { .n = 0 };
	struct findings findings = { .n = 0 };
	char *text = NULL;
	size_t size;
	FILE *out = open_memstream(&text, &size);

	for (int i = 0; i < 5; i++)
		tricks_note(&t, &(struct trick_found){ .kind = TRICK_PLANAR_SHADOW, .light = { 0, 5, 0, 1 }, .plane = { 0, 1, 0, i },
		            .has_opengl_light = i != 4 }, 1);
	relight_find_surfaces(&t, &maps, &solved, &findings);
	ck_assert_uint_eq(findings.n, 2);
	ck_assert_int_eq(findings_check(&findings), 0);
	findings_write(&findings, "a.trace", out);
	fclose(out);
	const char *first = strstr(text, "role:"), *second = first ? strstr(first + 1, "role:") : NULL;

	ck_assert_ptr_nonnull(second);
	ck_assert_ptr_null(strstr(second + 1, "role:"));
	ck_assert_ptr_nonnull(strstr(
		text, "4 draws in 1 frames are flattened away from one light each, 4 planes and lights in all; "));
	ck_assert(strstr(text, "left_out: yes") < second);
	ck_assert_ptr_nonnull(strstr(second, "plane: [0, 1, 0, 4]"));
	free(text);
	findings_free(&findings);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("tricks");

	tcase_add_test(tests, test_mirror_has_two_sides);
	tcase_add_test(tests, test_shadow_has_one_side);
	tcase_add_test(tests, test_one_rule_for_all_planes);
	return run_case(tests, "tricks");
}
