/*
 * Fragment programs (ARB_fragment_program): scene/program.h has their instructions. Each runs for the four pixels of llvmpipe's quad at once,
 * of which one is the fragment: textures take their levels from how coordinates change across the quad, whatever they were computed from.
 */
#pragma once

#include "kernels/gl/stages.h"
#include "scene/program.h"

#ifdef __OPENCL_VERSION__
#define M_LOG2(x) log2(x)
#else
#define M_LOG2(x) log2f(x)
#endif

/* A program in the words of scene.programs. */
struct program {
	GLOBAL const struct scene_program *head;
	GLOBAL const struct scene_instruction *instructions;
	GLOBAL const float *constants;
};

/* A fragment that runs one. Registers hold a number for each of the quad's pixels: x y in the upper row, z w in the lower one. */
struct program_run {
	const struct shade_arguments *a;
	struct point p;
	struct point_window window;
	uint32_t own; /* which of the four pixels the fragment is */
	int killed;
	struct vec4 registers[SCENE_PROGRAM_REGISTERS];
};

static inline struct program program_at(GLOBAL const uint32_t *words)
{
	struct program program;

	program.head = (GLOBAL const struct scene_program *)words;
	program.instructions = (GLOBAL const struct scene_instruction *)(program.head + 1);
	program.constants = (GLOBAL const float *)(program.instructions + program.head->n_instructions);
	return program;
}

static inline float program_of_four(struct vec4 v, uint32_t pixel)
{
	return pixel == 0u ? v.x : pixel == 1u ? v.y : pixel == 2u ? v.z : v.w;
}

static inline struct vec4 program_splat(float x)
{
	return v4(x, x, x, x);
}

/* --- Inputs -------------------------------------------------------------------------------------------------------- */

/* The same point of the triangle's plane as pixel `k` of the quad sees it. */
static inline struct point program_neighbour(const struct program_run *run, const struct point_quad *quad, uint32_t k)
{
	struct point p = run->p;

	if (k != run->own)
		point_weights_at(&p, run->window.view, quad->x + (float)(k & 1u) + 0.5f,
		                 (float)run->window.height - (quad->y + (float)(k >> 1u) + 0.5f), p.weight);
	return p;
}

/* Set pixel k's value of an input. */
static inline void program_set_input(struct program_run *run, uint32_t input, uint32_t k, struct vec4 value)
{
	float from[4];

	from[0] = value.x;
	from[1] = value.y;
	from[2] = value.z;
	from[3] = value.w;
	for (uint32_t i = 0u; i < 4u; i++) {
		struct vec4 *r = &run->registers[4u * input + i];

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

/* The unit's place among those of the material; SCENE_NONE: it is none of them. */
static inline uint32_t program_unit(const struct tables *t, GLOBAL const struct scene_material *m, uint32_t unit)
{
	for (uint32_t i = 0u; i < m->unit_count; i++)
		if (t->units[m->unit_first + i].unit == unit)
			return i;
	return SCENE_NONE;
}

static inline void program_texcoords(struct program_run *run, uint32_t inputs, const struct point_quad *quad)
{
	const struct tables *t = &run->a->tables;

	for (uint32_t unit = 0u; unit < SCENE_MAX_UNITS; unit++) {
		const uint32_t i = inputs >> (SCENE_INPUT_TEXCOORD + unit) & 1u ? program_unit(t, run->p.material, unit) : SCENE_NONE;
		struct point_planes planes;

		if (i == SCENE_NONE)
			continue;
		if (run->window.setup)
			point_texcoord_planes(t, &run->p, i, run->window.setup, &planes);
		for (uint32_t k = 0u; k < 4u; k++) {
			const struct point p = program_neighbour(run, quad, k);

			program_set_input(run, SCENE_INPUT_TEXCOORD + unit, k,
			                  run->window.setup ? point_texcoord_at(&planes, quad->x + (float)(k & 1u) + quad->middle,
			                                                        quad->y + (float)(k >> 1u) + quad->middle) :
			                                      point_texcoord(t, &p, i, p.weight));
		}
	}
}

static inline void program_position(struct program_run *run, const struct point_quad *quad, float depth)
{
	for (uint32_t k = 0u; k < 4u; k++) {
		const struct point p = program_neighbour(run, quad, k);
		const float w = p.vertex[0]->clip[3] * p.weight[0] + p.vertex[1]->clip[3] * p.weight[1] + p.vertex[2]->clip[3] * p.weight[2];

		program_set_input(run, SCENE_INPUT_POSITION, k,
		                  v4(quad->x + (float)(k & 1u) + 0.5f, (float)run->window.height - (quad->y + (float)(k >> 1u)) - 0.5f, depth, 1.0f / w));
	}
}

/* lit: the fragment's own colours */
static inline void program_inputs(struct program_run *run, uint32_t inputs, const struct lit *lit, float depth)
{
	struct point_quad quad;

	quad.x = (float)(run->window.x & ~1u);
	quad.y = (float)((run->window.height - 1u - run->window.row) & ~1u);
	quad.middle = 0.5f - clip_origin(run->window.view);
	program_texcoords(run, inputs, &quad);
	if (inputs >> SCENE_INPUT_POSITION & 1u)
		program_position(run, &quad, depth);
	for (uint32_t k = 0u; k < 4u; k++) {
		const struct point p = program_neighbour(run, &quad, k);
		struct lit here = k == run->own ? *lit : point_lit_from_vertices(&p);

		if (p.material->lighting)
			here.secondary.w = 1.0f; /* as Mesa's vertex programs leave it */
		program_set_input(run, SCENE_INPUT_COLOR, k, here.color);
		program_set_input(run, SCENE_INPUT_SECONDARY, k, here.secondary);
		program_set_input(run, SCENE_INPUT_FOG, k,
		                  v4(p.vertex[0]->fog_coord * p.weight[0] + p.vertex[1]->fog_coord * p.weight[1] + p.vertex[2]->fog_coord * p.weight[2],
		                     0.0f, 0.0f, 1.0f));
	}
}

/* --- Instructions -------------------------------------------------------------------------------------------------- */

/* Number `place` of an operand for the four pixels. */
static inline struct vec4 program_operand(const struct program_run *run, const struct program *program, uint32_t operand, uint32_t place,
                                          uint32_t negate)
{
	struct vec4 v = operand >= SCENE_PROGRAM_CONSTANT ? program_splat(program->constants[operand - SCENE_PROGRAM_CONSTANT + place]) :
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
	case SCENE_OP_EXP2: return M_EXP2(a);
	case SCENE_OP_LOG2: return M_LOG2(a);
	case SCENE_OP_SINE: return M_SIN(a);
	case SCENE_OP_COSINE: return M_COS(a);
	case SCENE_OP_MINIMUM: return M_MIN(a, b);
	case SCENE_OP_MAXIMUM: return M_MAX(a, b);
	case SCENE_OP_LESS: return a < b ? 1.0f : 0.0f;
	case SCENE_OP_GREATER_EQUAL: return a >= b ? 1.0f : 0.0f;
	case SCENE_OP_POWER: return M_POW(a, b);
	default: return a;
	}
}

static inline struct vec4 program_result(uint32_t operation, struct vec4 a, struct vec4 b, struct vec4 c)
{
	switch (operation) {
	case SCENE_OP_MOVE: return a;
	case SCENE_OP_ADD: return v4_add(a, b);
	case SCENE_OP_MULTIPLY: return v4_mul(a, b);
	case SCENE_OP_MAD: return v4_add(v4_mul(a, b), c);
	case SCENE_OP_SELECT:
		return v4(a.x < 0.0f ? b.x : c.x, a.y < 0.0f ? b.y : c.y, a.z < 0.0f ? b.z : c.z, a.w < 0.0f ? b.w : c.w);
	default:
		return v4(program_number(operation, a.x, b.x), program_number(operation, a.y, b.y), program_number(operation, a.z, b.z),
		          program_number(operation, a.w, b.w));
	}
}

/* One pixel's coordinates as textures take them: divided by the fourth. */
static inline struct vec4 program_coordinates(const struct program_run *run, GLOBAL const struct scene_instruction *in, uint32_t k)
{
	const struct vec4 *r = &run->registers[in->a];

	return v4(program_of_four(r[0], k), program_of_four(r[1], k), program_of_four(r[2], k),
	          in->c & SCENE_TEXTURE_DIVIDED ? program_of_four(r[3], k) : 1.0f);
}

/* The slopes of a level that is `bias` higher. llvmpipe's logarithm is straight between powers of two. */
static inline void program_bias(struct texture_slope *slope, float bias)
{
	const float rho2 = M_MAX(v4_dot(slope->right, slope->right), v4_dot(slope->down, slope->down));
	const float wanted = 2.0f * (texture_half_log2(rho2) + bias), whole = M_FLOOR(wanted);
	const float scale = rho2 > 1.0e-30f ? M_SQRT(M_EXP2(whole) * (1.0f + (wanted - whole)) / rho2) : 1.0f;

	slope->right = v4_scale(slope->right, scale);
	slope->down = v4_scale(slope->down, scale);
}

/* A texture that is not there, or not complete, is black. */
static inline void program_sample(struct program_run *run, GLOBAL const struct scene_instruction *in)
{
	const struct tables *t = &run->a->tables;
	const uint32_t place = program_unit(t, run->p.material, in->b);
	GLOBAL const struct scene_unit *unit = &t->units[run->p.material->unit_first + (place == SCENE_NONE ? 0u : place)];
	struct vec4 c[4], sample[4];

	for (uint32_t k = 0u; k < 4u; k++) {
		c[k] = program_coordinates(run, in, k);
		sample[k] = v4(0.0f, 0.0f, 0.0f, 1.0f);
	}
	for (uint32_t k = 0u; k < 4u && place != SCENE_NONE; k++) {
		const int slopes = texture_needs_slope(t, unit);
		struct texture_slope slope;

		if (slopes)
			slope = texture_slope(&t->textures[unit->texture], c[k], c[0], c[1], c[2]);
		if (slopes && in->c & SCENE_TEXTURE_BIASED)
			program_bias(&slope, program_of_four(run->registers[in->a + 3u], k));
		sample[k] = texture_sample(t, unit, c[k], slopes ? &slope : (const struct texture_slope *)0);
	}
	run->registers[in->to] = v4(sample[0].x, sample[1].x, sample[2].x, sample[3].x);
	run->registers[in->to + 1u] = v4(sample[0].y, sample[1].y, sample[2].y, sample[3].y);
	run->registers[in->to + 2u] = v4(sample[0].z, sample[1].z, sample[2].z, sample[3].z);
	run->registers[in->to + 3u] = v4(sample[0].w, sample[1].w, sample[2].w, sample[3].w);
}

static inline void program_execute(struct program_run *run, const struct program *program)
{
	for (uint32_t at = 0u; at < program->head->n_instructions && !run->killed; at++) {
		GLOBAL const struct scene_instruction *in = &program->instructions[at];

		if (in->operation == SCENE_OP_TEXTURE) {
			program_sample(run, in);
			continue;
		}
		for (uint32_t i = 0u; i < in->n; i++) {
			const uint32_t flags = in->flags;
			struct vec4 a = program_operand(run, program, in->a, flags & SCENE_STEP_A ? i : 0u, flags & SCENE_NEGATE_A), b = a, c = a;

			if (in->operation == SCENE_OP_KILL) {
				run->killed |= program_of_four(a, run->own) < 0.0f;
				continue;
			}
			if (in->operation >= SCENE_OP_ADD)
				b = program_operand(run, program, in->b, flags & SCENE_STEP_B ? i : 0u, flags & SCENE_NEGATE_B);
			if (in->operation >= SCENE_OP_MAD)
				c = program_operand(run, program, in->c, flags & SCENE_STEP_C ? i : 0u, flags & SCENE_NEGATE_C);
			a = program_result(in->operation, a, b, c);
			run->registers[in->to + i] = flags & SCENE_SATURATE ? v4_clamp01(a) : a;
		}
	}
}

/* --- Fragments ----------------------------------------------------------------------------------------------------- */

/* What `shade` has left of a fragment: its triangle, weights and colours. @return 0: none that a program shades */
static inline int program_begin(const struct shade_arguments *s, uint32_t item, struct setup_kept *kept, struct program_run *run,
                                struct lit *lit)
{
	GLOBAL const struct shaded *out = &s->shaded[item];
	const struct fragment f = s->fragments[item];
	struct vec3 seen[SCENE_MAX_LIGHTS];
	GLOBAL const uint32_t *group;
	uint32_t kind = 0u;

	if (!s->tables.materials[s->tables.geometries[f.instance].material].fragment_program || !(out->flags & SHADED_THERE) ||
	    out->flags & SHADED_STENCIL || (s->n_slots && !stage_dimmed(s->visibility, s->n_slots, s->n, item)))
		return 0;
	run->window.x = s->pixels[item] % s->width;
	run->window.row = s->pixels[item] / s->width;
	setup_keep(s, run->window.x, run->window.row, &f, 0, kept);
	run->a = s;
	run->p = kept->p;
	fragment_weights(f, kept->w_inv[0], kept->w_inv[1], kept->w_inv[2], run->p.weight);
	run->window.view = &s->views[run->p.geometry->view];
	run->window.setup = kept->have_setup ? &kept->setup : (const struct clip_setup *)0;
	run->window.kept = (struct point_kept *)0;
	run->window.height = s->height;
	run->own = (run->window.x & 1u) + 2u * ((s->height - 1u - run->window.row) & 1u);
	run->killed = 0;
	*lit = point_lit_from_vertices(&run->p);
	if (s->n_slots) {
		stage_seen(s->visibility, s->n_slots, s->n, item, seen);
		setup_keep_lit(&s->tables, seen, 0, kept);
		*lit = point_lit_between(&run->p, kept->lit);
	}
	if (run->p.geometry->flags & GEOMETRY_PIXELS) {
		group = stage_pixel_group(&s->tables, &run->p, run->window.x, s->height - 1u - run->window.row, &kind);
		if (kind == SCENE_COLOR_PIXELS || kind == SCENE_FLOAT_PIXELS)
			lit->color = stage_texel_color(group, kind);
	}
	return 1;
}

/* program: a fragment that `shade` has coloured by fixed function gets its program's colour and depth, or is discarded. */
static inline void program_item(const struct shade_arguments *a, uint32_t item)
{
	GLOBAL struct shaded *out = &a->shaded[item];
	struct setup_kept kept;
	struct program program;
	struct program_run run;
	struct vec4 color;
	struct lit lit;

	if (!program_begin(a, item, &kept, &run, &lit))
		return;
	program = program_at(a->programs + (run.p.material->fragment_program - 1u));
	for (uint32_t i = 0u; i < program.head->n_registers; i++)
		run.registers[i] = program_splat(0.0f);
	program_inputs(&run, program.head->inputs, &lit, a->fragments[item].depth);
	program_execute(&run, &program);
	if (run.killed) {
		out->flags = 0u;
		return;
	}
	color = v4(program_of_four(run.registers[SCENE_PROGRAM_COLOR], run.own), program_of_four(run.registers[SCENE_PROGRAM_COLOR + 1u], run.own),
	           program_of_four(run.registers[SCENE_PROGRAM_COLOR + 2u], run.own), program_of_four(run.registers[SCENE_PROGRAM_COLOR + 3u], run.own));
	color = run.p.material->unclamped & 1u ? color : v4_clamp01(color);
	color = v4(pixel_nudge(color.x), pixel_nudge(color.y), pixel_nudge(color.z), color.w);
	v3_store(out->shadowed, v3(color.x, color.y, color.z));
	if (!stage_is_path(a->transport) && !run.p.material->surface.relit)
		stage_store_direct(out, v3_add(v3(color.x, color.y, color.z), v3_load(run.p.material->surface.emission)));
	if (a->n_slots)
		return;
	color.w *= stage_coverage(&run.p);
	v4_store(out->gl, color);
	if (program.head->sets_depth)
		out->depth = clamp01(program_of_four(run.registers[SCENE_PROGRAM_DEPTH], run.own));
}
