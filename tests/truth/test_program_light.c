/* A program's result from a colour made by several lights: if one of them is blocked, the program gets the colour of
 * the others, each light alone. */
#include "tests/case.h"
#include "tests/truth/scenes.h"

#include "scene/program.h"

enum { SIZE = 32 };

static const float right[3] = { 1, 0, 0 }, up[3] = { 0, 1, 0 };

/* Inputs of a program that scales each colour. */
struct dimming {
	struct scene_program head;
	struct scene_instruction instruction;
	float share;
};

static void set_program(struct made *t, uint32_t material, float share, struct dimming *program)
{
	*program = (struct dimming){
		{ .n_instructions = 1, .n_constants = 1, .n_registers = SCENE_PROGRAM_FIRST + 4, .inputs = 1u << SCENE_INPUT_COLOR },
		{ SCENE_OP_MULTIPLY, 4, SCENE_STEP_A, SCENE_PROGRAM_COLOR, 4 * SCENE_INPUT_COLOR, SCENE_PROGRAM_CONSTANT, 0 },
		share,
	};
	t->scene.programs = (uint32_t *)program;
	t->scene.n_programs = sizeof(*program) / sizeof(uint32_t);
	t->materials[material].fragment_program = 1;
}

/* Two distant lights, from straight ahead and from the right. A square out of view above the picture's middle blocks
 * the second. */
START_TEST(test_two_lights)
{
	static const float down[4] = { 0, 0, 1, 0 }, slanted[4] = { 0.6f, 0, 0.8f, 0 };
	const float albedo = 0.5f, share = _i & 1 ? 0.75f : 1;
	const int is_by_program = _i & 1, blocked_first = _i >> 1;
	struct tracer_options options = { .mode = TRACER_WHITTED, .display = 1, .depth = 4 };
	const float *first = blocked_first ? slanted : down, *second = blocked_first ? down : slanted;
	struct dimming program;
	struct image img;
	uint32_t floor;
	struct made t;

	made_init(&t, SIZE, SIZE, 0);
	made_add_light(&t, first[0], first[1], first[2], first[3]);
	made_add_light(&t, second[0], second[1], second[2], second[3]);
	floor = made_add_material(&t, albedo);
	if (is_by_program)
		set_program(&t, floor, share, &program);
	made_add_square(&t, floor, (float[3]){ 0, 0, -10 }, right, up, 1, 1);
	made_add_square(&t, made_add_material(&t, 1), (float[3]){ 3, 0, -6 }, right, up, 0.5f, 1);
	truth_render_with(&t, &options, &img);
	ck_assert_float_eq_tol(truth_at(&img, "gl.R", SIZE / 2, SIZE / 2), share * albedo * 1.8f, 1e-3f);
	ck_assert_float_eq_tol(truth_at(&img, "R", SIZE / 2, SIZE / 2), share * albedo, 1e-3f);
	ck_assert_float_eq_tol(truth_at(&img, "R", 2, 2), share * albedo * 1.8f, 1e-3f);
	ck_assert_float_eq_tol(truth_at(&img, "shadow.R", SIZE / 2, SIZE / 2), 1 / 1.8f, 1e-3f);
	truth_check_closure(&img);
	image_free(&img);
	made_free(&t);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("program light");

	tcase_add_loop_test(tests, test_two_lights, 0, 4);
	return run_case(tests, "program light");
}
