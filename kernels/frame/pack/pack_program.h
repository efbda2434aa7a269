/*
 * Runs fragment programs for fragments of one material, sixteen lanes at once: what program.h and instructions.h do for
 * one fragment, in the same order of operations and with bit-identical results. OpenCL C only. If a program needs no
 * values of neighbouring pixels, each lane is a fragment; otherwise four lanes are the quad of one.
 */
#pragma once

#include "kernels/frame/pack/pack_function.h"
#include "kernels/frame/pack/pack_shade.h"
#include "kernels/frame/pack/pack_surface.h"
#include "kernels/gl/program.h"

/* Sixteen of struct program_run. */
struct pack_run {
	uint wanted, killed, lanes, mask, steps, ended; /* masks as there, one bit per lane */
	packf registers[SCENE_PROGRAM_REGISTERS];
};

/* Storage for a run of either stage. */
struct pack_runs {
	struct pack_run fragments;
	struct program_run vertices;
};

/* --- Instructions ------------------------------------------------------------------------------------------------ */

WIDE_VECTORS static inline packf pack_operand(const struct pack_run *run, const struct program *program, uint operand,
                                              uint place, uint negate)
{
	const packf v = operand >= SCENE_PROGRAM_CONSTANT ?
	                        (packf)(program->constants[operand - SCENE_PROGRAM_CONSTANT + place]) :
	                        run->registers[operand + place];

	return negate ? v * -1.0f : v;
}

WIDE_VECTORS static inline packf pack_truth(packi a)
{
	return select((packf)(0), (packf)(1), a);
}

WIDE_VECTORS static inline packf pack_result(uint operation, packf a, packf b, packf c)
{
	switch (operation) {
	case SCENE_OP_MOVE: return a;
	case SCENE_OP_ABSOLUTE: return fabs(a);
	case SCENE_OP_FLOOR: return floor(a);
	case SCENE_OP_FRACTION: return a - floor(a);
	case SCENE_OP_RECIPROCAL: return 1.0f / a;
	case SCENE_OP_INVERSE_ROOT: return 1.0f / sqrt(fabs(a));
	case SCENE_OP_EXP2:
		return function_exp2(a);
	case SCENE_OP_LOG2:
		return function_log2(a);
	case SCENE_OP_SINE:
		return function_turn(a, 0);
	case SCENE_OP_COSINE:
		return function_turn(a, 1);
	case SCENE_OP_SQUARE_ROOT: return sqrt(a);
	case SCENE_OP_TRUNCATE: return select(floor(a), -floor(-a), a < 0.0f);
	case SCENE_OP_ROUND: return rint(a);
	case SCENE_OP_DX: return a.s1133557799bbddff - a.s0022446688aaccee;
	case SCENE_OP_DY: return a.s010145458989cdcd - a.s23236767ababefef;
	case SCENE_OP_ADD: return a + b;
	case SCENE_OP_MULTIPLY: return a * b;
	case SCENE_OP_MINIMUM: return fmin(a, b);
	case SCENE_OP_MAXIMUM: return fmax(a, b);
	case SCENE_OP_LESS: return pack_truth(a < b);
	case SCENE_OP_GREATER_EQUAL: return pack_truth(a >= b);
	case SCENE_OP_POWER:
		return function_power(a, b);
	case SCENE_OP_DIVIDE: return a / b;
	case SCENE_OP_EQUAL: return pack_truth(a == b);
	case SCENE_OP_NOT_EQUAL: return pack_truth(a != b);
	case SCENE_OP_AND: return pack_truth((a != 0.0f) & (b != 0.0f));
	case SCENE_OP_AND_NOT: return pack_truth((a != 0.0f) & (b == 0.0f));
	case SCENE_OP_MAD: return a * b + c;
	case SCENE_OP_SELECT: return select(c, b, a < 0.0f);
	case SCENE_OP_CHOOSE: return select(c, b, a != 0.0f);
	default: return a;
	}
}

WIDE_VECTORS static inline void pack_keep(struct pack_run *run, uint place, packf v, uint mask)
{
	packf *r = &run->registers[place];

	*r = mask == run->lanes ? v : select(*r, v, pack_mask(mask));
}

/* program_fetch and program_store for all lanes. */
static inline void pack_fetch(struct pack_run *run, const struct program *program,
                              __global const struct scene_instruction *in)
{
	const packf at = pack_operand(run, program, in->b, 0, 0);
	const uint elements = in->c >> 16, numbers = in->c & 0xffff;

	for (uint i = 0; i < in->n; i++) {
		packf v = 0.0f;

		for (uint lane = 0; lane < PACK_SIZE; lane++) {
			const float element = LANE(at, const float, lane);
			uint place;

			if (!(element >= 0.0f && element < (float)elements))
				continue;
			place = in->a + (uint)element * numbers + i;
			LANE(v, float, lane) = in->a >= SCENE_PROGRAM_CONSTANT ? program->constants[place - SCENE_PROGRAM_CONSTANT] :
			                                                         LANE(run->registers[place], const float, lane);
		}
		pack_keep(run, in->to + i, v, run->mask);
	}
}

static inline void pack_store(struct pack_run *run, const struct program *program,
                              __global const struct scene_instruction *in)
{
	const packf value = pack_operand(run, program, in->a, 0, 0), at = pack_operand(run, program, in->b, 0, 0);

	for (uint left = run->mask; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);
		const float element = LANE(at, const float, lane);

		if (element >= 0.0f && element < (float)(in->c >> 16))
			LANE(run->registers[in->to + (uint)element * (in->c & 0xffff)], float, lane) = LANE(value, const float, lane);
	}
}

/* program_turn for all lanes. */
static inline uint pack_turn(struct pack_run *run, const struct program *program,
                             __global const struct scene_instruction *in, uint at)
{
	const uint is_true = in->operation == SCENE_OP_JUMP ?
	                             0 :
	                             run->lanes & pack_bits(pack_operand(run, program, in->a, 0, 0) != 0.0f);

	if (in->operation == SCENE_OP_MASK) {
		run->mask = is_true;
		return at;
	}
	if (is_true)
		return at;
	if (in->to <= at) {
		const uint back = at - in->to + 1;

		if (run->steps < back) {
			run->ended = 1;
			return program->head->n_instructions;
		}
		run->steps -= back;
	}
	return in->to - 1;
}

WIDE_VECTORS static inline void pack_compute(struct pack_run *run, const struct program *program,
                                             __global const struct scene_instruction *in)
{
	const uint flags = in->flags;

	for (uint i = 0; i < in->n; i++) {
		packf a = pack_operand(run, program, in->a, flags & SCENE_STEP_A ? i : 0, flags & SCENE_NEGATE_A), b = a, c = a;

		if (in->operation == SCENE_OP_KILL) {
			run->killed |= run->mask & pack_bits(a < 0.0f);
			continue;
		}
		if (in->operation >= SCENE_OP_ADD)
			b = pack_operand(run, program, in->b, flags & SCENE_STEP_B ? i : 0, flags & SCENE_NEGATE_B);
		if (in->operation >= SCENE_OP_MAD)
			c = pack_operand(run, program, in->c, flags & SCENE_STEP_C ? i : 0, flags & SCENE_NEGATE_C);
		a = pack_result(in->operation, a, b, c);
		pack_keep(run, in->to + i, flags & SCENE_SATURATE ? clamp01(a) : a,
		          flags & SCENE_UNMASKED ? run->lanes : run->mask);
	}
}

/* --- Textures ---------------------------------------------------------------------------------------------------- */

/* program_sample; lanes form quads. */
static inline void pack_look_up(const struct tables *t, const struct pack *p,
                                __global const struct scene_instruction *in, struct pack_run *run)
{
	const uint place = program_unit(t, p->material, in->b);
	__global const struct scene_unit *unit = &t->units[p->material->unit_first + (place == SCENE_NONE ? 0 : place)];
	const packf *at = &run->registers[in->a];
	const packf q = in->c & SCENE_TEXTURE_DIVIDED ? at[3] : (packf)(1);
	packf out[4] = { 0.0f, 0.0f, 0.0f, 1.0f };

	if (place != SCENE_NONE && pack_knows_texture(t, unit) &&
	    !(texture_needs_slope(t, unit) && in->c & (SCENE_TEXTURE_BIASED | SCENE_TEXTURE_LEVEL))) {
		const packf over = 1.0f / q, at_q[3] = { at[0] * over, at[1] * over, at[2] * over }, s = at_q[0], r = at_q[1];
		const float width = (float)t->textures[unit->texture].width, height = (float)t->textures[unit->texture].height;
		struct pack_slope slope;

		slope.right_s = (s.s111155559999dddd - s.s000044448888cccc) * width;
		slope.right_t = (r.s111155559999dddd - r.s000044448888cccc) * height;
		slope.down_s = (s.s22226666aaaaeeee - s.s000044448888cccc) * width;
		slope.down_t = (r.s22226666aaaaeeee - r.s000044448888cccc) * height;
		pack_sample_at(t, unit, at_q, &slope, -1, out);
	} else if (place != SCENE_NONE) {
		for (uint lane = 0; lane < PACK_SIZE; lane++) {
			struct vec4 quad[4], sample;

			for (uint k = 0; k < 4; k++) {
				const uint of = (lane & ~3u) + k;

				quad[k] = v4(LANE(at[0], const float, of), LANE(at[1], const float, of), LANE(at[2], const float, of),
				             LANE(q, const float, of));
			}
			sample = program_texel(t, unit, in->c, quad, lane & 3, LANE(at[3], const float, lane));
			LANE(out[0], float, lane) = sample.x;
			LANE(out[1], float, lane) = sample.y;
			LANE(out[2], float, lane) = sample.z;
			LANE(out[3], float, lane) = sample.w;
		}
	}
	for (uint i = 0; i < 4; i++)
		pack_keep(run, in->to + i, out[i], run->mask);
}

/* program_run_from and program_execute for all lanes. */
static inline void pack_execute(const struct tables *t, const struct pack *p, const struct program *program,
                                struct pack_run *run)
{
	for (uint at = 0; at < program->head->n_instructions && run->wanted & ~run->killed; at++) {
		__global const struct scene_instruction *in = &program->instructions[at];

		if (in->operation == SCENE_OP_TEXTURE)
			pack_look_up(t, p, in, run);
		else if (in->operation == SCENE_OP_FETCH)
			pack_fetch(run, program, in);
		else if (in->operation == SCENE_OP_STORE)
			pack_store(run, program, in);
		else if (in->operation >= SCENE_OP_MASK)
			at = pack_turn(run, program, in, at);
		else
			pack_compute(run, program, in);
	}
}

/* --- Inputs ------------------------------------------------------------------------------------------------------ */

/* program_light_corners, lane by lane. */
static inline void pack_light_again_by_program(const struct shade_arguments *a, const struct pack_list *list,
                                               const struct pack *p, uint lanes, struct pack_kept *kept,
                                               struct program_run *run, struct pack_corners_lit *lit)
{
	const struct vec4_16 none = v4_16(0, 0, 0, 0);

	for (int k = 0; k < 3; k++)
		lit->color[k] = lit->secondary[k] = none;
	for (; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);
		struct vec3 seen[SCENE_MAX_LIGHTS];
		struct pack_lit *l;
		int is_lit;

		stage_seen(a->visibility, a->n_slots, a->n, list->item[lane], seen);
		l = pack_keep_lit(&a->tables, list, p, lane, seen, kept, &is_lit);
		if (!is_lit)
			program_light_corners(a, &l->p, seen, run, l->lit);
		pack_take_lit(l->lit, p->material->shade_model == GL_FLAT, lane, lit);
	}
}

/* Light vertices again, with the lights' visibility once lights have been queried.
 * @return lit, which receives them; 0: they remain as they were lit first */
static inline const struct pack_corners_lit *pack_lit_again(const struct shade_arguments *a,
                                                            const struct pack_list *list, const struct pack *p,
                                                            uint lanes, struct pack_kept *kept,
                                                            struct program_run *run, struct pack_corners_lit *lit)
{
	if (stage_is_lit_by_program(a, p->material, 0))
		pack_light_again_by_program(a, list, p, lanes, kept, run, lit);
	else if (a->n_slots)
		pack_light_again(a, list, p, lanes, kept, lit);
	else
		return 0;
	return lit;
}

/* point_weights_at for triangles, at the lanes' pixels. */
WIDE_VECTORS static inline void pack_weights_at(const struct tables *t, const struct pack *p, uint height,
                                                packf *weight)
{
	const packf x = convert_float16(p->x) + 0.5f, y = (float)height - (convert_float16(p->row) + 0.5f);
	const struct vec3_16 at = v3_16(2.0f * (x - p->view->viewport[0]) / p->view->viewport[2] - 1.0f,
	                                2.0f * (y - p->view->viewport[1]) / p->view->viewport[3] - 1.0f, 1.0f);
	struct vec3_16 corner[3];
	packf sum;

	for (int k = 0; k < 3; k++) {
		packf clip[4];

		pack_vertex(t, p, k, PACK_CLIP, clip);
		corner[k] = v3_16(clip[0], clip[1], clip[3]);
	}
	weight[0] = v3_dot(v3_cross(corner[1], corner[2]), at);
	weight[1] = v3_dot(v3_cross(corner[2], corner[0]), at);
	weight[2] = v3_dot(v3_cross(corner[0], corner[1]), at);
	sum = weight[0] + weight[1] + weight[2];
	sum = select((packf)(0), 1.0f / sum, sum != 0.0f);
	for (int i = 0; i < 3; i++)
		weight[i] *= sum;
}

/* program_texcoords for all lanes. */
WIDE_VECTORS static inline void pack_input_texcoords(const struct shade_arguments *a, const struct pack_list *list,
                                                     const struct pack *p, uint lanes, struct pack_kept *kept,
                                                     uint inputs, const struct pack_places *at, struct pack_run *run)
{
	const packu first = pack_texcoord_first(&a->tables, list, p->material, lanes, p->uniform);

	for (uint i = 0; i < p->material->unit_count; i++) {
		const uint unit = a->tables.units[p->material->unit_first + i].unit;
		packf texcoord[3][4];

		if (!(inputs >> (SCENE_INPUT_TEXCOORD + unit) & 1))
			continue;
		pack_texcoords(a, list, p, lanes, first, i, kept, texcoord);
		pack_by_planes(p, at, texcoord, 0, 3, &run->registers[4 * (SCENE_INPUT_TEXCOORD + unit)]);
	}
}

/* Interpolate a number of the vertices' rows at the lanes' points, as for positions and fog. */
WIDE_VECTORS static inline packf pack_weighted(const struct tables *t, const struct pack *p, uint four, int number)
{
	packf row[3][4];

	for (int k = 0; k < 3; k++)
		pack_vertex(t, p, k, (packu)(four), row[k]);
	return row[0][number] * p->weight[0] + row[1][number] * p->weight[1] + row[2][number] * p->weight[2];
}

/* program_position for all lanes. */
WIDE_VECTORS static inline void pack_input_position(const struct tables *t, const struct pack *p, uint height,
                                                    struct pack_run *run)
{
	packf *to = &run->registers[4 * SCENE_INPUT_POSITION];

	to[0] = convert_float16(p->x) + 0.5f;
	to[1] = (float)height - convert_float16(p->row) - 0.5f;
	to[2] = p->depth;
	to[3] = 1.0f / pack_weighted(t, p, PACK_CLIP, 3);
}

/* program_colors_by_planes for all lanes. */
WIDE_VECTORS static inline void pack_colors_by_planes(const struct shade_arguments *a, const struct pack_list *list,
                                                      const struct pack *p, uint lanes, struct pack_kept *kept,
                                                      uint inputs, const struct pack_places *at,
                                                      const struct pack_corners_lit *again, struct pack_run *run)
{
	for (uint input = SCENE_INPUT_COLOR; input <= SCENE_INPUT_FOG; input++) {
		packf *to = &run->registers[4 * input], row[3][4];

		if (!(inputs >> input & 1))
			continue;
		for (int k = 0; k < 3; k++) {
			if (input == SCENE_INPUT_FOG)
				pack_vertex(&a->tables, p, k, (packu)(PACK_NORMAL), row[k]);
			else if (input == SCENE_INPUT_COLOR)
				pack_corner_color(a, p, k, PACK_COLOR, again ? again->color : 0, row[k]);
			else
				pack_corner_color(a, p, k, PACK_SECONDARY, again ? again->secondary : 0, row[k]);
		}
		if (input != SCENE_INPUT_FOG && p->material->shade_model == GL_FLAT) {
			for (int i = 0; i < 4; i++)
				to[i] = row[2][i];
			continue;
		}
		pack_cut_rows(a, list, p, lanes, kept, again != 0, row);
		pack_by_planes(p, at, row, input == SCENE_INPUT_FOG ? 3 : 0, 3, to);
	}
	run->registers[4 * SCENE_INPUT_FOG + 3] = 1.0f;
}

/* Turn lanes into the other pixels of their fragments' quads. */
WIDE_VECTORS static inline void pack_spread(const struct tables *t, uint height, packi is_own, struct pack *p)
{
	const packi k = PACK_LANES & 3;
	packf weight[3];

	p->x = (p->x & ~1) + (k & 1);
	p->row = (p->row & ~1) + (k >> 1);
	pack_weights_at(t, p, height, weight);
	for (int i = 0; i < 3; i++)
		p->weight[i] = select(weight[i], p->weight[i], is_own);
}

/* program_begin for all lanes. */
static inline void pack_begin(const struct shade_arguments *a, const struct pack_list *list, const struct pack *p,
                              const struct program *program, uint own, struct pack_run *run)
{
	run->wanted = run->lanes = own;
	for (uint quad = 0xf; program->head->across && quad < 0x10000; quad <<= 4)
		run->lanes |= own & quad ? quad : 0;
	run->mask = run->lanes;
	run->killed = 0;
	run->steps = SCENE_PROGRAM_STEPS;
	run->ended = 0;
	for (uint i = 0; i < program->head->n_registers; i++)
		run->registers[i] = 0.0f;
	for (uint i = 0; i < program->head->n_lights; i++) {
		__global const struct scene_program_light *light = &program->lights[i];
		__global const float *sent = program->constants + light->from;
		struct vec3_16 share = v3_16(1, 1, 1);

		if (p->material->vertex_program)
			share = pack_seen(a, list, run->lanes, light->slot);
		run->registers[light->to] = sent[0] * share.x;
		run->registers[light->to + 1] = sent[1] * share.y;
		run->registers[light->to + 2] = sent[2] * share.z;
		run->registers[light->to + 3] = sent[3];
	}
}

/* --- Fragments --------------------------------------------------------------------------------------------------- */

/* Store the colours of some lanes in struct shaded. */
static inline void pack_store_program(const struct shade_arguments *a, const struct pack_list *list,
                                      const struct pack *p, uint lanes, const struct vec4_16 *color)
{
	const int is_direct = !stage_is_path(a->transport) && !p->material->surface.relit;
	const struct vec4_16 nudged = v4_16(pixel_nudge(color->x), pixel_nudge(color->y), pixel_nudge(color->z),
	                                    color->w);

	for (; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);
		__global struct shaded *out = &a->shaded[list->item[lane]];
		const struct vec4 gl = v4_lane(&nudged, lane);
		const struct vec3 c = v3(gl.x, gl.y, gl.z);

		v3_store(out->shadowed, c);
		if (is_direct)
			stage_store_direct(out, v3_add(c, v3_load(p->material->surface.emission)));
		if (!a->n_slots)
			v4_store(out->gl, gl);
	}
}

/* Fixed function's fragment stage for fragments whose vertices a vertex program has lit. */
static inline void pack_fixed(const struct shade_arguments *a, const struct pack_list *list, struct pack *p, uint lanes,
                              struct pack_kept *kept, struct pack_runs *runs)
{
	struct vec4_16 lit, secondary, color;
	struct pack_texturing texturing;
	struct pack_corners_lit corners;
	const struct pack_corners_lit *again;

	pack_texture(a, list, p, lanes, kept, &texturing);
	again = pack_lit_again(a, list, p, lanes, kept, &runs->vertices, &corners);
	pack_lit_by_planes(a, list, p, lanes, kept, again, &lit, &secondary);
	color = pack_finish(&a->tables, p, &texturing, &lit, &secondary);
	pack_store_program(a, list, p, lanes, &color);
}

/*
 * Run a fragment program for the lanes of a pack. p: with the fragments' own places own: the lanes that are fragments;
 * if lanes form quads, the others are other pixels of the same triangle
 */
static inline void pack_run_program(const struct shade_arguments *a, const struct pack_list *list, struct pack *p,
                                    uint own, const struct program *program, struct pack_kept *kept,
                                    struct pack_runs *runs)
{
	const uint inputs = program->head->inputs,
		   colors = inputs & (1 << SCENE_INPUT_COLOR | 1 << SCENE_INPUT_SECONDARY | 1 << SCENE_INPUT_FOG);
	const packi is_own = pack_mask(own);
	struct pack_run *run = &runs->fragments;
	const struct pack_corners_lit *again;
	struct pack_corners_lit corners;
	struct vec4_16 color;
	struct pack_places at;
	const packf *ends;

	pack_begin(a, list, p, program, own, run);
	again = colors ? pack_lit_again(a, list, p, run->lanes, kept, &runs->vertices, &corners) : 0;
	if (program->head->across)
		pack_spread(&a->tables, a->height, is_own, p);
	at = pack_places(p);
	if (colors)
		pack_colors_by_planes(a, list, p, run->lanes, kept, inputs, &at, again, run);
	if (colors && p->material->lighting)
		run->registers[4 * SCENE_INPUT_SECONDARY + 3] = 1.0f;
	if (inputs >> SCENE_INPUT_POSITION & 1)
		pack_input_position(&a->tables, p, a->height, run);
	run->registers[4 * SCENE_INPUT_FACE] = pack_truth(p->front);
	pack_input_texcoords(a, list, p, run->lanes, kept, inputs, &at, run);
	pack_execute(&a->tables, p, program, run);
	program_note_ended(a->programs + (p->material->fragment_program - 1), run->ended);
	ends = &run->registers[program_color(program, a->output)];
	color = v4_16(ends[0], ends[1], ends[2], ends[3]);
	color = p->material->unclamped & 1 ? color : v4_clamp01(color);
	for (uint left = program->head->sets_depth && !a->n_slots ? own : 0; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);

		a->shaded[list->item[lane]].depth = clamp01(LANE(run->registers[SCENE_PROGRAM_DEPTH], const float, lane));
	}
	for (uint left = own & run->killed; left; left &= left - 1)
		a->shaded[list->item[popcount((left & -left) - 1)]].flags = 0;
	pack_store_program(a, list, p, own & ~run->killed, &color);
}

/* Copy lane `from` of another list to lane `to`. */
static inline void pack_copy_lane(const struct pack_list *list, uint from, uint to, struct pack_list *out)
{
	out->item[to] = list->item[from];
	out->instance[to] = list->instance[from];
	out->primitive[to] = list->primitive[from];
	out->pixel[to] = list->pixel[from];
	out->b1[to] = list->b1[from];
	out->b2[to] = list->b2[from];
	out->depth[to] = list->depth[from];
}

/* Index of a pixel in its quad. */
static inline uint pack_own(const struct shade_arguments *a, uint pixel)
{
	return (pixel % a->width & 1) + 2 * ((a->height - 1 - pixel / a->width) & 1);
}

/* pack_program for programs where four lanes are the quad of a fragment. p: with material and view */
static inline uint pack_program_across(const struct shade_arguments *a, const struct pack_list *list, uint lanes,
                                       int unplaced, const struct program *program, struct pack_kept *kept,
                                       struct pack_runs *runs, struct pack *p)
{
	uint done = 0;

	while (lanes) {
		uint from[4], own = 0, n = 0;
		struct pack_list quads;

		for (; lanes && n < 4; lanes &= lanes - 1) {
			from[n] = popcount((lanes & -lanes) - 1);
			own |= 1u << (4 * n + pack_own(a, list->pixel[from[n]]));
			n++;
		}
		for (uint lane = 0; lane < PACK_SIZE; lane++)
			pack_copy_lane(list, from[min(lane / 4, n - 1)], lane, &quads);
		p->primitive = SCENE_NONE; /* the program may have changed it */
		own &= pack_place(a, &quads, 0xffff, unplaced, kept, p);
		if (own)
			pack_run_program(a, &quads, p, own, program, kept, runs);
		for (uint f = 0; f < n; f++)
			done |= own >> 4 * f & 15 ? 1u << from[f] : 0;
	}
	return done;
}

/*
 * program_item for fragments of one material that satisfy pack_knows_program. unplaced: 1 if their weights and depths
 * are still the camera's
 * @return the lanes that are done: none in slivers
 */
static inline uint pack_program(const struct shade_arguments *a, const struct pack_list *list, uint lanes, int unplaced,
                                struct pack_kept *kept, struct pack_runs *runs)
{
	__global const struct geometry *g = &a->tables.geometries[list->instance[popcount((lanes & -lanes) - 1)]];
	__global const struct scene_material *m = &a->tables.materials[g->material];
	const struct program program = program_at(a->programs + (m->fragment_program ? m->fragment_program - 1 : 0));
	struct pack p;

	p.material = m;
	p.view = &a->views[g->view];
	if (m->fragment_program && program.head->across)
		return pack_program_across(a, list, lanes, unplaced, &program, kept, runs, &p);
	p.primitive = SCENE_NONE;
	lanes = pack_place(a, list, lanes, unplaced, kept, &p);
	if (lanes && m->fragment_program)
		pack_run_program(a, list, &p, lanes, &program, kept, runs);
	else if (lanes)
		pack_fixed(a, list, &p, lanes, kept, runs);
	return lanes;
}

/* Test whether pack_program supports everything that a material needs. pack_knows_geometry has to hold for the
 * fragments' geometries. */
static inline int pack_knows_program(const struct shade_arguments *a, __global const struct scene_material *m)
{
	return m->fragment_program || pack_is_plain(a, m);
}
