/*
 * The opacity of surfaces for rays that only ask whether light arrives: a surface stops the ray, lets all of it pass,
 * or has to be sampled. Rays end at, or ignore, most of a cut-out leaf without sampling its texture (H. Gruen, C.
 * Benthin and S. Woop, "Sub-triangle opacity masks for faster ray tracing of transparent objects", HPG 2020).
 *
 * An instance has one of the values below, or words in a pool: one for each primitive, followed by their maps. A map
 * divides a triangle's barycentric coordinates b1, b2 into n x n cells with two bits each; half of them are used.
 * Written by tracer/frame/place/opacity.c; read by the kernels _packet and _wide. Other kernels stop at every surface,
 * which is then sampled (shadow_walk): the same light arrives.
 */
#pragma once

#include "kernels/common.h"
#include "kernels/rays/rays.h"

/* The share of a ray's light that counts as none. It remains behind opaque surfaces whose interpolated alpha is not
 * exactly 1. */
#define OPACITY_LEAST (1.0f / 65536.0f)

#define OPACITY_STOPS 0u
#define OPACITY_PASSES 1u
#define OPACITY_ASK 2u    /* depends on the place or the ray: to be sampled */
#define OPACITY_MAP 3u    /* primitives only: depends on the cell */
#define OPACITY_WORDS 4u  /* instances only: from here on, 4 + the index of the first word */

/* A primitive's word: one of OPACITY_*, sides that rays to lights pass (INSTANCE_PASS_* >> OPACITY_SIDES_SHIFT), the
 * binary logarithm of n, and the index of the map's first word, counted from the instance's first. */
#define OPACITY_SIDES_SHIFT 6u
#define OPACITY_SIDES 12u
#define OPACITY_LEVEL 4u
#define OPACITY_PLACE 7u
#define OPACITY_MOST_LEVEL 5u

/* The word of an instance's primitive. opacity: the instance's value */
static inline uint32_t opacity_word(GLOBAL const uint32_t *words, uint32_t opacity, uint32_t primitive)
{
	return opacity < OPACITY_WORDS ? opacity : words[opacity - OPACITY_WORDS + primitive];
}

/* The sides of a primitive that rays to lights pass, in addition to its instance's: INSTANCE_PASS_* */
static inline uint32_t opacity_sides(uint32_t word, uint32_t to_lights)
{
	return to_lights ? (word & OPACITY_SIDES) << OPACITY_SIDES_SHIFT : 0u;
}

/* Number of words of a map. */
static inline uint32_t opacity_map_words(uint32_t level)
{
	return level > 2u ? 1u << (2u * level - 4u) : 1u;
}

static inline uint32_t opacity_cell(float b, uint32_t n)
{
	float place = b * (float)n;

	return place > 0.0f ? (uint32_t)M_MIN(place, (float)(n - 1u)) : 0u;
}

/* The opacity of a primitive with this word at b1, b2: OPACITY_STOPS, OPACITY_PASSES or OPACITY_ASK. */
static inline uint32_t opacity_at(GLOBAL const uint32_t *words, uint32_t opacity, uint32_t word, float b1, float b2)
{
	uint32_t level = word >> OPACITY_LEVEL & 7u, cell;

	if ((word & 3u) != OPACITY_MAP)
		return word & 3u;
	cell = opacity_cell(b2, 1u << level) << level | opacity_cell(b1, 1u << level);
	return words[opacity - OPACITY_WORDS + (word >> OPACITY_PLACE) + (cell >> 4)] >> 2u * (cell & 15u) & 3u;
}
