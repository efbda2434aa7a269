/*
 * Samples that depend on neither time nor scheduling, from sequences that fill the unit square evenly. In mode path,
 * each pixel, bounce, purpose and frame scrambles Sobol's sequence with its own number. In other modes, each pixel and
 * purpose rotates a single sequence.
 */
#pragma once

#include "kernels/common.h"

/* The purpose of a sample. Adjacent values in this list do not interact. */
#define SAMPLE_LIGHT 0x10000u /* + slot of the light */
#define SAMPLE_BOUNCE 0x20000u
#define SAMPLE_CHOICE 0x30000u
#define SAMPLE_GLOSS 0x40000u
#define SAMPLE_JITTER 0x50000u
#define SAMPLE_DOME 0x60000u
#define SAMPLE_EMITTER 0x70000u

#include "kernels/frame/light/sample_lanes.h"

/*
 * Element `index` of the sequence with steps 1/p and 1/p^2, p^3 = p + 1 (M. Roberts, "The unreasonable effectiveness of
 * quasirandom sequences", 2018), in units of 2^-32, offset by the seed.
 */
static inline void sample_square(uint32_t seed, uint32_t index, float *u, float *v)
{
	*u = sample_unit(index * 3242174889u + sample_hash(seed));
	*v = sample_unit(index * 2447445414u + sample_hash(seed ^ 0x9e3779b9u));
}

/*
 * Sample `index` for a purpose. frame: 0: as in sample_square; else Sobol's sequence, scrambled with this number of the
 * frame
 */
static inline void sample_take(uint32_t frame, uint32_t seed, uint32_t index, float *u, float *v)
{
	if (frame)
		sample_sobol(seed ^ sample_hash(frame), index, u, v);
	else
		sample_square(seed, index, u, v);
}

/*
 * Sample positions within a pixel: a (0,2)-sequence. Any 2^k consecutive samples that start at a multiple of 2^k put
 * one sample in each of 2^k columns, rows and other equal divisions of the pixel. Its digits are permuted by a hash
 * (Kollig and Keller 2002, "Efficient multidimensional sampling", sec. 3.1). There are SAMPLE_TURNS permutations, and a
 * hash of the pixel's number picks one. Neighbours thus have different samples, so edges and fine patterns leave noise
 * instead of bands. There are only a few, because each needs a traced picture of its own: camera rays keep to the pixel
 * grid, which is shifted as a whole.
 */
#define SAMPLE_TURNS 4u

static inline uint32_t sample_turn(uint32_t pixel)
{
	return sample_hash(pixel + SAMPLE_JITTER) % SAMPLE_TURNS;
}

/* 1 if a pixel takes part in a turn. The value SAMPLE_TURNS means all pixels, for mode path, where noise hides
 * bands. */
static inline int sample_takes_part(uint32_t pixel, uint32_t turn)
{
	return turn == SAMPLE_TURNS || sample_turn(pixel) == turn;
}

/*
 * Offset from the centre, in pixels, of sample `index` (1 and up; 0 is the pixel's centre) for the pixels of a turn. A
 * margin of 1/256 pixel, the step that vertices are snapped to, stays free at the sides, where the picture's own border
 * may be clipped.
 */
static inline void sample_shift(uint32_t turn, uint32_t index, float shift[2])
{
	uint32_t reversed = 0u, sobol = 0u, digit = 0x80000000u;

	for (uint32_t bit = 0u; bit < 32u; bit++, digit ^= digit >> 1) {
		reversed |= (index >> bit & 1u) << (31u - bit);
		sobol ^= index >> bit & 1u ? digit : 0u;
	}
	shift[0] = (sample_unit(reversed ^ sample_hash(SAMPLE_JITTER + turn)) - 0.5f) * 0.9921875f;
	shift[1] = (sample_unit(sobol ^ sample_hash(SAMPLE_JITTER + 0x100u + turn)) - 0.5f) * 0.9921875f;
}

/*
 * Time of the same sample while the shutter is open, as a fraction [-0.5,0.5) of the exposure. Index 0 is its middle.
 */
static inline float sample_time(uint32_t turn, uint32_t index)
{
	/* steps of the golden ratio, in units of 2^-32: even, and unrelated to the positions above */
	return sample_unit(index * 2654435769u + (turn % SAMPLE_TURNS) * 0x40000000u + 0x80000000u) - 0.5f;
}

/* A point, uniform in area, of the unit disk perpendicular to `n`. */
static inline struct vec3 sample_disk(struct vec3 n, float u, float v)
{
	struct vec3 a, b;
	float r = M_SQRT(u), turn = 6.283185307179586f * v;

	sample_basis(n, &a, &b);
	return v3_add(v3_scale(a, r * M_COS(turn)), v3_scale(b, r * M_SIN(turn)));
}

/* A direction about the unit vector `n`, with a density proportional to the cosine to it. */
static inline struct vec3 sample_cosine(struct vec3 n, float u, float v)
{
	return v3_normalize(v3_add(sample_disk(n, u, v), v3_scale(n, M_SQRT(1.0f - u))));
}
