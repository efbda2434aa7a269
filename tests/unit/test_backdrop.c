/* Recognition of a backdrop: the first draws of a frame that serve as background (scene/backdrop.h). */
#include "scene/backdrop.h"

#include "scene/scene.h"
#include "tests/case.h"

static uint32_t backdrop(uint32_t buffers, uint32_t before, int32_t width)
{
	struct scene_clear clears[2] = { { .buffers = 7, .scissor = { 0, 0, 640, 480 } },
	                                 { .before_instance = before, .buffers = buffers, .scissor = { 0, 0, width, 480 } } };
	const struct scene s = { .width = 640, .height = 480, .clears = clears, .n_clears = 2, .n_instances = 20 };

	return scene_backdrop(&s);
}

START_TEST(test_backdrop)
{
	ck_assert_uint_eq(backdrop(2, 5, 640), 5);  /* a sky box, then the world */
	ck_assert_uint_eq(backdrop(6, 5, 640), 5);  /* stencil is cleared as well */
	ck_assert_uint_eq(backdrop(2, 15, 640), 0); /* the world, then an object held by the viewer */
	ck_assert_uint_eq(backdrop(3, 5, 640), 0);  /* nothing is visible */
	ck_assert_uint_eq(backdrop(2, 5, 320), 0);  /* covers only part of the window */
	ck_assert_uint_eq(backdrop(1, 5, 640), 0);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("backdrop");

	tcase_add_test(tests, test_backdrop);
	return run_case(tests, "backdrop");
}
