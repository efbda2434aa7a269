/* Texture lookups in programs of either stage: the instruction that instructions.h leaves to the stage. */
#pragma once

#include "kernels/gl/instructions.h"
#include "kernels/gl/texture.h"

/* The unit's index among the material's; SCENE_NONE: the material does not use it. */
static inline uint32_t program_unit(const struct tables *t, GLOBAL const struct scene_material *m, uint32_t unit)
{
	for (uint32_t i = 0u; i < m->unit_count; i++)
		if (t->units[m->unit_first + i].unit == unit)
			return i;
	return SCENE_NONE;
}

/* Texture coordinates of one of the four: divided by the fourth component. */
static inline struct vec4 program_coordinates(const struct program_run *run, GLOBAL const struct scene_instruction *in,
                                              uint32_t k)
{
	const struct vec4 *r = &run->registers[in->a];

	return v4(program_of_four(r[0], k), program_of_four(r[1], k), program_of_four(r[2], k),
	          in->c & SCENE_TEXTURE_DIVIDED ? program_of_four(r[3], k) : 1.0f);
}

/* Slopes for a level that is `bias` higher. llvmpipe's logarithm is linear between powers of two. */
static inline void program_bias(struct texture_slope *slope, float bias)
{
	const float rho2 = M_MAX(v4_dot(slope->right, slope->right), v4_dot(slope->down, slope->down));
	const float wanted = 2.0f * (texture_half_log2(rho2) + bias), whole = M_FLOOR(wanted);
	const float scale = rho2 > 1.0e-30f ? M_SQRT(M_EXP2(whole) * (1.0f + (wanted - whole)) / rho2) : 1.0f;

	slope->right = v4_scale(slope->right, scale);
	slope->down = v4_scale(slope->down, scale);
}

/*
 * The texture sample of one of the four.
 * @param quad   coordinates of all four. k: index of the one
 * @param level  the fourth component, if the instruction uses it as a level or a bias
 */
static inline struct vec4 program_texel(const struct tables *t, GLOBAL const struct scene_unit *unit, uint32_t flags,
                                        const struct vec4 *quad, uint32_t k, float level)
{
	const uint32_t at = texture_has_own_slopes(t, unit) ? k : 0u;
	struct texture_slope slope;

	if (!texture_needs_slope(t, unit))
		return texture_sample(t, unit, quad[k], (const struct texture_slope *)0);
	slope.right = v4(1.0f, 0.0f, 0.0f, 0.0f);
	slope.down = v4(0.0f, 1.0f, 0.0f, 0.0f);
	if (!(flags & SCENE_TEXTURE_LEVEL))
		slope = texture_slope(&t->textures[unit->texture], quad[at], quad[at ^ 1u], quad[at ^ 2u]);
	if (flags & (SCENE_TEXTURE_BIASED | SCENE_TEXTURE_LEVEL))
		program_bias(&slope, level);
	return texture_sample(t, unit, quad[k], &slope);
}

/* A missing or incomplete texture is black. */
static inline void program_sample(const struct tables *t, GLOBAL const struct scene_material *m,
                                  GLOBAL const struct scene_instruction *in, struct program_run *run)
{
	const uint32_t place = program_unit(t, m, in->b);
	GLOBAL const struct scene_unit *unit = &t->units[m->unit_first + (place == SCENE_NONE ? 0u : place)];
	struct vec4 c[4], sample[4];

	for (uint32_t k = 0u; k < 4u; k++) {
		c[k] = program_coordinates(run, in, k);
		sample[k] = v4(0.0f, 0.0f, 0.0f, 1.0f);
	}
	for (uint32_t k = 0u; k < 4u && place != SCENE_NONE; k++)
		sample[k] = program_texel(t, unit, in->c, c, k, program_of_four(run->registers[in->a + 3u], k));
	program_keep(run, in->to, v4(sample[0].x, sample[1].x, sample[2].x, sample[3].x), run->mask);
	program_keep(run, in->to + 1u, v4(sample[0].y, sample[1].y, sample[2].y, sample[3].y), run->mask);
	program_keep(run, in->to + 2u, v4(sample[0].z, sample[1].z, sample[2].z, sample[3].z), run->mask);
	program_keep(run, in->to + 3u, v4(sample[0].w, sample[1].w, sample[2].w, sample[3].w), run->mask);
}

/* m: the material whose textures are used */
static inline void program_execute(const struct tables *t, GLOBAL const struct scene_material *m,
                                   const struct program *program, struct program_run *run)
{
	for (uint32_t at = 0u; (at = program_run_from(run, program, at)) < program->head->n_instructions; at++)
		program_sample(t, m, &program->instructions[at], run);
}
