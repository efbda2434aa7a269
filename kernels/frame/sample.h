/*
 * Samples that depend on neither time nor scheduling: a sequence fills the unit square evenly. In mode path each pixel,
 * bounce, purpose and frame scrambles Sobol's by a number of its own; elsewhere each pixel and purpose turns one.
 */
#pragma once

#include "kernels/common.h"

/* What a sample is for: neighbours in this list share nothing. */
#define SAMPLE_LIGHT 0x10000u /* + slot of the light */
#define SAMPLE_BOUNCE 0x20000u
#define SAMPLE_CHOICE 0x30000u
#define SAMPLE_GLOSS 0x40000u
#define SAMPLE_JITTER 0x50000u
#define SAMPLE_DOME 0x60000u
#define SAMPLE_EMITTER 0x70000u

#include "kernels/frame/sample_lanes.h"

/*
 * Number `index` of the sequence with steps 1/p and 1/p^2, p^3 = p + 1 (M. Roberts, "The unreasonable effectiveness of
 * quasirandom sequences", 2018), in 2^-32, moved by the seed.
 */
static inline void sample_square(uint32_t seed, uint32_t index, float *u, float *v)
{
	*u = sample_unit(index * 3242174889u + sample_hash(seed));
	*v = sample_unit(index * 2447445414u + sample_hash(seed ^ 0x9e3779b9u));
}

/* Sample `index` of a purpose. frame: 0: as sample_square has it; else Sobol's, by this number of the frame */
static inline void sample_take(uint32_t frame, uint32_t seed, uint32_t index, float *u, float *v)
{
	if (frame)
		sample_sobol(seed ^ sample_hash(frame), index, u, v);
	else
		sample_square(seed, index, u, v);
}

/*
 * Where samples fall within a pixel: a (0,2)-sequence, of which any 2^k in a row from a multiple of 2^k on hold one in
 * each of 2^k columns, rows and other even cuts of the pixel, its digits exchanged by a hash (Kollig and Keller 2002,
 * "Efficient multidimensional sampling", sec. 3.1). There are so many exchanges, and a hash of the pixel's number picks
 * one: neighbours have different samples, so that edges and fine patterns leave noise and no bands. Few, because a
 * picture is traced for each: camera rays keep to the pixel grid, moved as a whole.
 */
#define SAMPLE_TURNS 4u

static inline uint32_t sample_turn(uint32_t pixel)
{
	return sample_hash(pixel + SAMPLE_JITTER) % SAMPLE_TURNS;
}

/* 1 where a pixel takes part in a turn. SAMPLE_TURNS is the turn of all pixels: in mode path, where noise hides
 * bands. */
static inline int sample_takes_part(uint32_t pixel, uint32_t turn)
{
	return turn == SAMPLE_TURNS || sample_turn(pixel) == turn;
}

/*
 * Sample `index` (1 and up; 0 is the pixel's centre) of the pixels of a turn: by how much it is off the centre, pixels.
 * A step of 1/256 pixel, to which vertices are snapped, is left at the sides: there the picture's own border may be cut
 * away.
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

/* When the same sample is taken, while a shutter is open: [-0.5,0.5) of that time. Index 0 is its middle. */
static inline float sample_time(uint32_t turn, uint32_t index)
{
	/* steps of the golden ratio, in 2^-32: evenly, and not as the places above */
	return sample_unit(index * 2654435769u + (turn % SAMPLE_TURNS) * 0x40000000u + 0x80000000u) - 0.5f;
}

/* A point of the disk of radius 1 that stands across `n`, even in area. */
static inline struct vec3 sample_disk(struct vec3 n, float u, float v)
{
	struct vec3 a, b;
	float r = M_SQRT(u), turn = 6.283185307179586f * v;

	sample_basis(n, &a, &b);
	return v3_add(v3_scale(a, r * M_COS(turn)), v3_scale(b, r * M_SIN(turn)));
}

/* A direction about the unit vector `n`, as often as the cosine to it. */
static inline struct vec3 sample_cosine(struct vec3 n, float u, float v)
{
	return v3_normalize(v3_add(sample_disk(n, u, v), v3_scale(n, M_SQRT(1.0f - u))));
}
