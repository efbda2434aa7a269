/*
 * Runs the programs of a draw, instruction by instruction (scene/program.h), for four fragments or vertices at once.
 * This file has what both stages share: program.h runs fragments, vertex_program.h vertices.
 */
#pragma once

#include "kernels/common.h"
#include "kernels/gl/functions.h"
#include "scene/program.h"

#ifdef __OPENCL_VERSION__
#define M_ROUND(x) rint(x)
#define M_STORE_ONE(place) (void)atomic_xchg((volatile __global uint *)(place), 1u)
#else
#define M_ROUND(x) rintf(x)
#define M_STORE_ONE(place) __atomic_store_n(place, 1u, __ATOMIC_RELAXED)
#endif

/* A program, as encoded in scene.programs. */
struct program {
	GLOBAL const struct scene_program *head;
	GLOBAL const struct scene_instruction *instructions;
	GLOBAL const struct scene_program_light *lights;
	GLOBAL const float *constants;
};

/* A running program. Registers hold a number for each of the four. */
struct program_run {
	uint32_t wanted; /* mask of those of the four whose results are used */
	uint32_t killed; /* mask of those that were discarded */
	uint32_t lanes;  /* mask of those that are computed; the others' numbers are undefined */
	uint32_t mask;   /* mask of those in `lanes` that are active */
	uint32_t steps;  /* number of loop iterations still allowed */
	uint32_t ended;  /* 1: the limit was reached */
	struct vec4 registers[SCENE_PROGRAM_REGISTERS];
};

static inline struct program program_at(GLOBAL const uint32_t *words)
{
	struct program program;

	program.head = (GLOBAL const struct scene_program *)words;
	program.instructions = (GLOBAL const struct scene_instruction *)(program.head + 1);
	program.lights = (GLOBAL const struct scene_program_light *)(program.instructions + program.head->n_instructions);
	program.constants = (GLOBAL const float *)(program.lights + program.head->n_lights);
	return program;
}

/* Record in a program that a run of it hit the loop limit, if it did. words: the program's own */
static inline void program_note_ended(GLOBAL uint32_t *words, uint32_t ended)
{
	if (ended)
		M_STORE_ONE(&((GLOBAL struct scene_program *)words)->ended);
}

/* First register of a fragment's colour. output: scene.output */
static inline uint32_t program_color(const struct program *program, uint32_t output)
{
	return output < program->head->n_data ? program->head->data + 4u * output : SCENE_PROGRAM_COLOR;
}

static inline float program_of_four(struct vec4 v, uint32_t pixel)
{
	return pixel == 0u ? v.x : pixel == 1u ? v.y : pixel == 2u ? v.z : v.w;
}

static inline struct vec4 program_splat(float x)
{
	return v4(x, x, x, x);
}

/* seen: NULL, or how much of each of the material's lights arrives */
static inline void program_begin(struct program_run *run, const struct program *program, uint32_t wanted,
                                 const struct vec3 *seen)
{
	run->wanted = wanted;
	run->killed = 0u;
	run->lanes = run->mask = program->head->across ? 15u : wanted;
	run->steps = SCENE_PROGRAM_STEPS;
	run->ended = 0u;
	for (uint32_t i = 0u; i < program->head->n_registers; i++)
		run->registers[i] = program_splat(0.0f);
	for (uint32_t i = 0u; i < program->head->n_lights; i++) {
		GLOBAL const struct scene_program_light *light = &program->lights[i];
		const struct vec3 share = seen ? seen[light->slot] : v3(1.0f, 1.0f, 1.0f);
		GLOBAL const float *sent = program->constants + light->from;

		run->registers[light->to] = program_splat(sent[0] * share.x);
		run->registers[light->to + 1u] = program_splat(sent[1] * share.y);
		run->registers[light->to + 2u] = program_splat(sent[2] * share.z);
		run->registers[light->to + 3u] = program_splat(sent[3]);
	}
}

/* Set four registers, starting at `first`, for number k of the four. */
static inline void program_set(struct program_run *run, uint32_t first, uint32_t k, struct vec4 value)
{
	float from[4];

	from[0] = value.x;
	from[1] = value.y;
	from[2] = value.z;
	from[3] = value.w;
	for (uint32_t i = 0u; i < 4u; i++) {
		struct vec4 *r = &run->registers[first + i];

		if (k == 0u)
			r->x = from[i];
		else if (k == 1u)
			r->y = from[i];
		else if (k == 2u)
			r->z = from[i];
		else
			r->w = from[i];
	}
}

/* Read four registers. */
static inline struct vec4 program_get(const struct program_run *run, uint32_t first, uint32_t k)
{
	const struct vec4 *r = &run->registers[first];

	return v4(program_of_four(r[0], k), program_of_four(r[1], k), program_of_four(r[2], k), program_of_four(r[3], k));
}

/* Component `place` of an operand for all four. */
static inline struct vec4 program_operand(const struct program_run *run, const struct program *program,
                                          uint32_t operand, uint32_t place, uint32_t negate)
{
	struct vec4 v = operand >= SCENE_PROGRAM_CONSTANT ?
	                        program_splat(program->constants[operand - SCENE_PROGRAM_CONSTANT + place]) :
	                        run->registers[operand + place];

	return negate ? v4_scale(v, -1.0f) : v;
}

static inline float program_number(uint32_t operation, float a, float b)
{
	switch (operation) {
	case SCENE_OP_ABSOLUTE: return M_ABS(a);
	case SCENE_OP_FLOOR: return M_FLOOR(a);
	case SCENE_OP_FRACTION: return a - M_FLOOR(a);
	case SCENE_OP_RECIPROCAL: return 1.0f / a;
	case SCENE_OP_INVERSE_ROOT: return 1.0f / M_SQRT(M_ABS(a));
	case SCENE_OP_EXP2: return function_exp2(a);
	case SCENE_OP_LOG2: return function_log2(a);
	case SCENE_OP_SINE: return function_turn(a, 0u);
	case SCENE_OP_COSINE: return function_turn(a, 1u);
	case SCENE_OP_MINIMUM: return M_MIN(a, b);
	case SCENE_OP_MAXIMUM: return M_MAX(a, b);
	case SCENE_OP_LESS: return a < b ? 1.0f : 0.0f;
	case SCENE_OP_GREATER_EQUAL: return a >= b ? 1.0f : 0.0f;
	case SCENE_OP_POWER: return function_power(a, b);
	case SCENE_OP_SQUARE_ROOT: return M_SQRT(a);
	case SCENE_OP_TRUNCATE: return a < 0.0f ? -M_FLOOR(-a) : M_FLOOR(a);
	case SCENE_OP_ROUND: return M_ROUND(a);
	case SCENE_OP_DIVIDE: return a / b;
	case SCENE_OP_EQUAL: return a == b ? 1.0f : 0.0f;
	case SCENE_OP_NOT_EQUAL: return a != b ? 1.0f : 0.0f;
	case SCENE_OP_AND: return a != 0.0f && b != 0.0f ? 1.0f : 0.0f;
	case SCENE_OP_AND_NOT: return a != 0.0f && b == 0.0f ? 1.0f : 0.0f;
	default: return a;
	}
}

/* lanes: as in struct program_run */
static inline struct vec4 program_result(uint32_t operation, struct vec4 a, struct vec4 b, struct vec4 c,
                                         uint32_t lanes)
{
	switch (operation) {
	case SCENE_OP_MOVE: return a;
	case SCENE_OP_ADD: return v4_add(a, b);
	case SCENE_OP_MULTIPLY: return v4_mul(a, b);
	case SCENE_OP_MAD: return v4_add(v4_mul(a, b), c);
	case SCENE_OP_SELECT:
		return v4(a.x < 0.0f ? b.x : c.x, a.y < 0.0f ? b.y : c.y, a.z < 0.0f ? b.z : c.z, a.w < 0.0f ? b.w : c.w);
	case SCENE_OP_CHOOSE:
		return v4(a.x != 0.0f ? b.x : c.x, a.y != 0.0f ? b.y : c.y, a.z != 0.0f ? b.z : c.z, a.w != 0.0f ? b.w : c.w);
	case SCENE_OP_DX: return v4(a.y - a.x, a.y - a.x, a.w - a.z, a.w - a.z);
	case SCENE_OP_DY: return v4(a.x - a.z, a.y - a.w, a.x - a.z, a.y - a.w);
	default:
		return v4(lanes & 1u ? program_number(operation, a.x, b.x) : 0.0f,
		          lanes & 2u ? program_number(operation, a.y, b.y) : 0.0f,
		          lanes & 4u ? program_number(operation, a.z, b.z) : 0.0f,
		          lanes & 8u ? program_number(operation, a.w, b.w) : 0.0f);
	}
}

/* Store a result for the active lanes. */
static inline void program_keep(struct program_run *run, uint32_t place, struct vec4 v, uint32_t mask)
{
	struct vec4 *r = &run->registers[place];

	if (mask == run->lanes)
		*r = v;
	else
		*r = v4(mask & 1u ? v.x : r->x, mask & 2u ? v.y : r->y, mask & 4u ? v.z : r->z, mask & 8u ? v.w : r->w);
}

/* A bit for each lane whose number is true. */
static inline uint32_t program_true(struct vec4 a)
{
	return (a.x != 0.0f ? 1u : 0u) | (a.y != 0.0f ? 2u : 0u) | (a.z != 0.0f ? 4u : 0u) | (a.w != 0.0f ? 8u : 0u);
}

/* An array element, indexed by one of the four. */
static inline float program_element(const struct program_run *run, const struct program *program,
                                    GLOBAL const struct scene_instruction *in, uint32_t i, uint32_t k, float element)
{
	const uint32_t elements = in->c >> 16, numbers = in->c & 0xffffu;
	uint32_t place;

	if (!(element >= 0.0f && element < (float)elements))
		return 0.0f;
	place = (uint32_t)element * numbers + i;
	return in->a >= SCENE_PROGRAM_CONSTANT ? program->constants[in->a - SCENE_PROGRAM_CONSTANT + place] :
	                                         program_of_four(run->registers[in->a + place], k);
}

static inline void program_fetch(struct program_run *run, const struct program *program,
                                 GLOBAL const struct scene_instruction *in)
{
	const struct vec4 at = program_operand(run, program, in->b, 0u, 0u);

	for (uint32_t i = 0u; i < in->n; i++)
		program_keep(run, in->to + i,
		             v4(program_element(run, program, in, i, 0u, at.x),
		                program_element(run, program, in, i, 1u, at.y),
		                program_element(run, program, in, i, 2u, at.z),
		                program_element(run, program, in, i, 3u, at.w)),
		             run->mask);
}

static inline void program_store(struct program_run *run, const struct program *program,
                                 GLOBAL const struct scene_instruction *in)
{
	const struct vec4 value = program_operand(run, program, in->a, 0u, 0u),
			  at = program_operand(run, program, in->b, 0u, 0u);

	for (uint32_t k = 0u; k < 4u; k++) {
		const float element = program_of_four(at, k);

		if (element >= 0.0f && element < (float)(in->c >> 16))
			program_keep(run, in->to + (uint32_t)element * (in->c & 0xffffu), value, run->mask & 1u << k);
	}
}

/* MASK, JUMP, JUMP_NONE. @return the number of the instruction before the next one */
static inline uint32_t program_turn(struct program_run *run, const struct program *program,
                                    GLOBAL const struct scene_instruction *in, uint32_t at)
{
	const uint32_t is_true = in->operation == SCENE_OP_JUMP ?
	                                 0u :
	                                 run->lanes & program_true(program_operand(run, program, in->a, 0u, 0u));

	if (in->operation == SCENE_OP_MASK) {
		run->mask = is_true;
		return at;
	}
	if (is_true)
		return at;
	if (in->to <= at) {
		const uint32_t back = at - in->to + 1u;

		if (run->steps < back) {
			run->ended = 1u;
			return program->head->n_instructions;
		}
		run->steps -= back;
	}
	return in->to - 1u;
}

/* An instruction that computes numbers independently for each of the four. */
static inline void program_compute(struct program_run *run, const struct program *program,
                                   GLOBAL const struct scene_instruction *in)
{
	const uint32_t flags = in->flags;

	for (uint32_t i = 0u; i < in->n; i++) {
		struct vec4 a = program_operand(run, program, in->a, flags & SCENE_STEP_A ? i : 0u,
		                                flags & SCENE_NEGATE_A),
			    b = a, c = a;

		if (in->operation == SCENE_OP_KILL) {
			run->killed |= run->mask & ((a.x < 0.0f ? 1u : 0u) | (a.y < 0.0f ? 2u : 0u) |
			                            (a.z < 0.0f ? 4u : 0u) | (a.w < 0.0f ? 8u : 0u));
			continue;
		}
		if (in->operation >= SCENE_OP_ADD)
			b = program_operand(run, program, in->b, flags & SCENE_STEP_B ? i : 0u, flags & SCENE_NEGATE_B);
		if (in->operation >= SCENE_OP_MAD)
			c = program_operand(run, program, in->c, flags & SCENE_STEP_C ? i : 0u, flags & SCENE_NEGATE_C);
		a = program_result(in->operation, a, b, c, run->lanes);
		program_keep(run, in->to + i, flags & SCENE_SATURATE ? v4_clamp01(a) : a,
		             flags & SCENE_UNMASKED ? run->lanes : run->mask);
	}
}

/*
 * Run instructions from number `at` on, until one that belongs to the stage (TEXTURE), the end, or until no lane is
 * left whose result is used.
 * @return the number of that instruction; n_instructions: the program has ended
 */
static inline uint32_t program_run_from(struct program_run *run, const struct program *program, uint32_t at)
{
	for (; at < program->head->n_instructions && run->wanted & ~run->killed; at++) {
		GLOBAL const struct scene_instruction *in = &program->instructions[at];

		if (in->operation == SCENE_OP_TEXTURE)
			return at;
		if (in->operation == SCENE_OP_FETCH)
			program_fetch(run, program, in);
		else if (in->operation == SCENE_OP_STORE)
			program_store(run, program, in);
		else if (in->operation >= SCENE_OP_MASK)
			at = program_turn(run, program, in, at);
		else
			program_compute(run, program, in);
	}
	return program->head->n_instructions;
}
