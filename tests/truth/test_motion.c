/*
 * Motion vectors in closed form: a viewer who moves sideways, a rotating square, one with moving vertices, and new
 * objects. Depth must not affect static ones.
 */
#include <math.h>

#include "tests/case.h"
#include "tests/truth/scenes.h"
#include "verbs/render/vectors.h"

#define SIZE 64

static const float right[3] = { 1, 0, 0 }, up[3] = { 0, 1, 0 };

/* The motion vectors of a frame relative to another. */
static void find(const struct made *before, const struct made *now, struct image *img)
{
	const struct tracer_options options = { .mode = TRACER_GL, .display = 1 };
	struct vectors_frame *frame = before ? vectors_note(&before->scene) : NULL;

	truth_render_with(now, &options, img);
	ck_assert_int_eq(vectors_add(&now->scene, frame, img), 0);
	vectors_free(&frame);
}

static void make_square(struct made *t, float tangent, float r)
{
	made_init(t, SIZE, SIZE, tangent);
	made_add_square(t, made_add_material(t, 1), (float[3]){ 0, 0, -10 }, right, up, r, 2);
}

/* In the picture's central part, each pixel at (x, y) from the middle must have been at the position given by `was`. */
static void check(const struct image *img, void (*was)(float x, float y, float out[2]))
{
	for (uint32_t y = SIZE / 4; y < SIZE * 3 / 4; y++)
		for (uint32_t x = SIZE / 4; x < SIZE * 3 / 4; x++) {
			const float at[2] = { (float)x + 0.5f - SIZE / 2, (float)y + 0.5f - SIZE / 2 };
			float then[2];

			was(at[0], at[1], then);
			ck_assert_float_eq(truth_at(img, "motion.A", x, y), 1);
			ck_assert_float_eq_tol(truth_at(img, "motion.X", x, y), at[0] - then[0], 1e-3f);
			ck_assert_float_eq_tol(truth_at(img, "motion.Y", x, y), at[1] - then[1], 1e-3f);
		}
}

/* At distance 10 half the picture is 10 units: half a unit to the right and a quarter up are 1.6 and 0.8 pixels. */
static void was_aside(float x, float y, float out[2])
{
	out[0] = x - 1.6f;
	out[1] = y + 0.8f;
}

static void was_nearer(float x, float y, float out[2])
{
	out[0] = x * 10 / 8;
	out[1] = y * 10 / 8;
}

/* A counter-clockwise rotation, as seen, by 0.2; y points down. */
static void was_turned(float x, float y, float out[2])
{
	out[0] = cosf(0.2f) * x - sinf(0.2f) * y;
	out[1] = sinf(0.2f) * x + cosf(0.2f) * y;
}

static void was_half(float x, float y, float out[2])
{
	out[0] = x / 2;
	out[1] = y / 2;
}

static void was_there(float x, float y, float out[2])
{
	out[0] = x;
	out[1] = y;
}

START_TEST(test_moved)
{
	static void (*const was[])(float x, float y, float out[2]) = { was_aside, was_nearer, was_turned, was_half,
		                                                       was_there };
	struct made before, now;
	struct image img;
	float *m;

	make_square(&before, 1, _i == 3 ? 10 : 20);
	make_square(&now, 1, 20);
	m = now.instances[0].modelview;
	if (_i == 0)
		m[12] = 0.5f, m[13] = 0.25f;
	if (_i == 1)
		before.instances[0].modelview[14] = 2;
	if (_i == 2)
		m[0] = m[5] = cosf(0.2f), m[1] = sinf(0.2f), m[4] = -m[1];
	find(&before, &now, &img);
	check(&img, was[_i]);
	image_free(&img);
	made_free(&before);
	made_free(&now);
}
END_TEST

/* New objects, empty pixels, and first frames have no vectors. */
START_TEST(test_unknown)
{
	struct made before, now;
	struct image img;

	for (int first = 0; first < 2; first++) {
		make_square(&before, 1, 5);
		make_square(&now, 1, 5);
		made_add_ball(&now, 0, (float[3]){ 0, 0, -9 }, 3, 8, 0);
		find(first ? NULL : &before, &now, &img);
		ck_assert_float_eq(truth_at(&img, "id", SIZE / 2, SIZE / 2), 2);
		ck_assert_float_eq(truth_at(&img, "motion.A", SIZE / 2, SIZE / 2), 0);
		ck_assert_float_eq(truth_at(&img, "motion.X", SIZE / 2, SIZE / 2), 0);
		ck_assert_float_eq(truth_at(&img, "motion.A", 0, 0), 0);
		ck_assert_float_eq(truth_at(&img, "id", SIZE / 4 + 2, SIZE / 4 + 2), 1);
		ck_assert_float_eq(truth_at(&img, "motion.A", SIZE / 4 + 2, SIZE / 4 + 2), (float)!first);
		image_free(&img);
		made_free(&before);
		made_free(&now);
	}
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("motion");

	tcase_add_loop_test(tests, test_moved, 0, 5);
	tcase_add_test(tests, test_unknown);
	return run_case(tests, "motion");
}
