/* Instructions of programs (scene/program.h) at known values, for the four pixels of a quad at once;
 * kernels/gl/instructions.h. */
#include <math.h>
#include <string.h>

#include "kernels/gl/stages.h"
#include "kernels/gl/program.h"
#include "tests/case.h"

struct row {
	uint32_t operation;
	float a[4], b[4], c[4], wanted[4];
};

#define ONE(operation, ...) { SCENE_OP_##operation, { __VA_ARGS__ }, { 0 }, { 0 }, 
#define TWO(operation, a, b) { SCENE_OP_##operation, a, b, { 0 },
#define FOUR(...) { __VA_ARGS__ }

static const struct row rows[] = {
	ONE(MOVE, 1, -2, 0, 0.01f) { 1, -2, 0, 0.01f } },
	ONE(ABSOLUTE, 1, -2, 0, -0.5f) { 1, 2, 0, 0.5f } },
	ONE(FLOOR, 1.5f, -1.5f, 2, -0.25f) { 1, -2, 2, -1 } },
	ONE(FRACTION, 1.25f, -1.25f, 2, -0.5f) { 0.25f, 0.75f, 0, 0.5f } },
	ONE(RECIPROCAL, 4, -2, 0.5f, 1) { 0.25f, -0.5f, 2, 1 } },
	ONE(INVERSE_ROOT, 4, -16, 0.25f, 1) { 0.5f, 0.25f, 2, 1 } },
	ONE(EXP2, 3, -2, 0, 0.5f) { 8, 0.25f, 1, 1.41421356f } },
	ONE(LOG2, 8, 0.25f, 1, 1.41421356f) { 3, -2, 0, 0.5f } },
	ONE(SINE, 0, 0.52359878f, 1.57079633f, -1.57079633f) { 0, 0.5f, 1, -1 } },
	ONE(COSINE, 0, 1.04719755f, 1.57079633f, 3.14159265f) { 1, 0.5f, 0, -1 } },
	ONE(SQUARE_ROOT, 4, 0, 0.25f, 2) { 2, 0, 0.5f, 1.41421356f } },
	ONE(TRUNCATE, 1.75f, -1.75f, 2, -0.25f) { 1, -1, 2, 0 } },
	ONE(ROUND, 1.5f, 2.5f, -1.75f, 0.25f) { 2, 2, -2, 0 } },
	ONE(DX, 1, 4, 10, 30) { 3, 3, 20, 20 } },
	ONE(DY, 1, 4, 10, 30) { -9, -26, -9, -26 } }, /* the first two are in the upper row */
	TWO(ADD, FOUR(1, 2, -3, 0), FOUR(0.5f, -2, 4, 0)) { 1.5f, 0, 1, 0 } },
	TWO(MULTIPLY, FOUR(1, 2, -3, 0), FOUR(0.5f, -2, 4, 7)) { 0.5f, -4, -12, 0 } },
	TWO(MINIMUM, FOUR(1, 2, -3, 0), FOUR(0.5f, -2, 4, 0)) { 0.5f, -2, -3, 0 } },
	TWO(MAXIMUM, FOUR(1, 2, -3, 0), FOUR(0.5f, -2, 4, 0)) { 1, 2, 4, 0 } },
	TWO(LESS, FOUR(1, 2, -3, 0), FOUR(0.5f, 2, 4, 0)) { 0, 0, 1, 0 } },
	TWO(GREATER_EQUAL, FOUR(1, 2, -3, 0), FOUR(0.5f, 2, 4, 0)) { 1, 1, 0, 1 } },
	TWO(POWER, FOUR(2, 4, 0.5f, 3), FOUR(3, 0.5f, -2, 0)) { 8, 2, 4, 1 } },
	TWO(DIVIDE, FOUR(1, 2, -3, 0), FOUR(4, -2, 0.5f, 7)) { 0.25f, -1, -6, 0 } },
	TWO(EQUAL, FOUR(1, 2, -3, 0), FOUR(1, -2, 4, 0)) { 1, 0, 0, 1 } },
	TWO(NOT_EQUAL, FOUR(1, 2, -3, 0), FOUR(1, -2, 4, 0)) { 0, 1, 1, 0 } },
	TWO(AND, FOUR(1, 0.01f, 0, 0), FOUR(-1, 0, 4, 0)) { 1, 0, 0, 0 } },
	TWO(AND_NOT, FOUR(1, 0.01f, 0, 0), FOUR(-1, 0, 4, 0)) { 0, 1, 0, 0 } },
	{ SCENE_OP_MAD, { 1, 2, -3, 0 }, { 0.5f, -2, 4, 7 }, { 1, 1, 2, 5 }, { 1.5f, -3, -10, 5 } },
	{ SCENE_OP_SELECT, { -0.01f, 0, 0.01f, -5 }, { 1, 2, 3, 4 }, { 5, 6, 7, 8 }, { 1, 6, 7, 4 } },
	{ SCENE_OP_SELECT, { 0, -0.01f, -5, 0.01f }, { 1, 2, 3, 4 }, { 5, 6, 7, 8 }, { 5, 2, 3, 8 } },
	{ SCENE_OP_CHOOSE, { 0, 0.01f, -0.0f, 0 }, { 1, 2, 3, 4 }, { 5, 6, 7, 8 }, { 5, 2, 7, 8 } },
	{ SCENE_OP_CHOOSE, { -0.01f, 0, 0.01f, 5 }, { 1, 2, 3, 4 }, { 5, 6, 7, 8 }, { 1, 6, 3, 4 } },
};

START_TEST(test_results)
{
	uint32_t tried = 0;

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		const struct vec4 v = program_result(rows[i].operation, v4_load(rows[i].a), v4_load(rows[i].b),
		                                     v4_load(rows[i].c), 15);
		const float have[4] = { v.x, v.y, v.z, v.w };

		tried |= 1u << rows[i].operation;
		for (int k = 0; k < 4; k++)
			ck_assert_msg(fabsf(have[k] - rows[i].wanted[k]) <= 2e-6f * fmaxf(1, fabsf(have[k])),
			              "operation %u, number %d: %.9g, not %.9g", rows[i].operation, k, have[k],
			              rows[i].wanted[k]);
	}
	ck_assert_uint_eq(tried, (1u << SCENE_OP_KILL) - 1); /* all instructions with a purely numeric result */
}
END_TEST

/* Inactive lanes are left alone by expensive instructions and by masked stores of results. */
START_TEST(test_lanes)
{
	struct program_run run = { .lanes = 15, .mask = 15 };
	const struct vec4 v = v4(1, 2, 3, 4);

	for (uint32_t lanes = 0; lanes < 16; lanes++) {
		const struct vec4 half = program_result(SCENE_OP_RECIPROCAL, v4(2, 2, 2, 2), v, v, lanes);

		ck_assert(half.x == (lanes & 1 ? 0.5f : 0) && half.y == (lanes & 2 ? 0.5f : 0) &&
		          half.z == (lanes & 4 ? 0.5f : 0) && half.w == (lanes & 8 ? 0.5f : 0));
		run.registers[3] = v4(-1, -2, -3, -4);
		program_keep(&run, 3, v, lanes);
		for (uint32_t k = 0; k < 4; k++)
			ck_assert_float_eq(program_of_four(run.registers[3], k), (float)(k + 1) * (lanes >> k & 1 ? 1 : -1));
		ck_assert_uint_eq(program_true(v4(lanes & 1 ? 0.01f : 0, lanes & 2 ? -1 : 0, lanes & 4 ? 5 : 0,
		                                  lanes & 8 ? 1 : -0.0f)),
		                  lanes);
	}
	for (uint32_t k = 0; k < 4; k++)
		program_set(&run, 8, k, v4_add(v, v4(10.0f * (float)k, 10.0f * (float)k, 10.0f * (float)k, 10.0f * (float)k)));
	for (uint32_t k = 0; k < 4; k++) {
		const struct vec4 got = program_get(&run, 8, k);
		const float first = 10.0f * (float)k;

		ck_assert(got.x == first + 1 && got.y == first + 2 && got.z == first + 3 && got.w == first + 4);
	}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("instructions");

	tcase_add_test(tcase, test_results);
	tcase_add_test(tcase, test_lanes);
	return run_case(tcase, "instructions");
}
