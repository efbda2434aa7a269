/*
 * The channel "layers": the number of fragments blended into a pixel since it was last overwritten. Gate R1b allows
 * half a code for each, so a wrong number would hide faults or report false ones.
 *
 * Eight sheets, each from its own strip to the right border, drawn in order; the numbers are counted by hand.
 */

#include "tests/truth/scenes.h"
#include "tests/case.h"

enum { STRIPS = 8, STRIP = 8, SIZE = STRIPS * STRIP, CLEARED_ROWS = 16 };

/** A sheet over the full height, from the left border of a strip to the picture's right border. */
static void add_sheet(struct made *t, uint32_t material, int first_strip, float z)
{
	float left = 2.0f * (float)first_strip / STRIPS - 1, half = (1 - left) / 2;

	made_add_square(t, material, (float[3]){ left + half, 0, z }, (float[3]){ half, 0, 0 }, (float[3]){ 0, 1, 0 }, 1, 1);
}

static uint32_t add_film(struct made *t)
{
	uint32_t film = made_add_material(t, 0.5f);

	t->materials[film].blend = 1;
	t->materials[film].blend_src_rgb = t->materials[film].blend_src_alpha = GL_SRC_ALPHA;
	t->materials[film].blend_dst_rgb = t->materials[film].blend_dst_alpha = GL_ONE_MINUS_SRC_ALPHA;
	t->materials[film].depth_write = 0;
	return film;
}

START_TEST(test_number_of_layers)
{
	/* by the wall and later sheets, see below */
	static const float counted[STRIPS] = { 1, 1, 2, 2, 2, 2, 0, 1 }, after_clear[STRIPS] = { 0, 0, 0, 0, 0, 0, 0, 1 };
	static const char *const modes[] = { "gl", "whitted" };
	struct made t;

	made_init(&t, SIZE, SIZE, 0);
	uint32_t wall = made_add_material(&t, 0.5f), film = add_film(&t), discarded = add_film(&t),
		 red = made_add_material(&t, 0.5f);

	t.materials[discarded].alpha_test = 1;
	t.materials[discarded].alpha_func = GL_NEVER;
	t.materials[red].color_mask = 1;
	add_sheet(&t, wall, 1, -10);
	add_sheet(&t, film, 0, -9);      /* over the wall, and over the background: 1 */
	add_sheet(&t, film, 2, -8);      /* 2 */
	add_sheet(&t, film, 3, -20);     /* hidden by the wall: still 2 */
	add_sheet(&t, discarded, 4, -7); /* still 2 */
	add_sheet(&t, red, 5, -6);       /* green and blue were blended before: still 2 */
	add_sheet(&t, wall, 6, -5);      /* overwritten: 0 */
	add_sheet(&t, film, 7, -4);      /* 1 */

	/* before the last sheet, the lowest rows are cleared */
	struct scene_clear clears[2] = { t.clear, t.clear };

	clears[1].before_instance = 7;
	clears[1].buffers = 1;
	clears[1].scissor[3] = CLEARED_ROWS;
	t.scene.clears = clears;
	t.scene.n_clears = 2;

	for (size_t m = 0; m < sizeof(modes) / sizeof(modes[0]); m++) {
		struct image img;

		truth_render(&t, modes[m], &img);
		for (uint32_t y = 0; y < SIZE; y++)
			for (uint32_t x = 0; x < SIZE; x++) {
				const float *expected = y >= SIZE - CLEARED_ROWS ? after_clear : counted;

				ck_assert_msg(truth_at(&img, "layers", x, y) == expected[x / STRIP], "%s: %g layers at (%u, %u), not %g",
				              modes[m], (double)truth_at(&img, "layers", x, y), x, y, (double)expected[x / STRIP]);
			}
		image_free(&img);
	}
	made_free(&t);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("layers");

	tcase_set_timeout(tests, 120);
	tcase_add_test(tests, test_number_of_layers);
	return run_case(tests, "layers");
}
