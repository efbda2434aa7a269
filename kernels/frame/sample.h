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

/* Mix the bits of a number: multiply, shift and xor (constants found by C. Wellons, "Prospecting for hash
 * functions"). */
static inline uint32_t sample_hash(uint32_t x)
{
	x ^= x >> 16;
	x *= 0x7feb352du;
	x ^= x >> 15;
	x *= 0x846ca68bu;
	x ^= x >> 16;
	return x;
}

static inline float sample_unit(uint32_t x)
{
	return (float)(x >> 8) * 5.9604644775390625e-8f; /* 2^-24: below 1 */
}

/*
 * Number `index` of the sequence with steps 1/p and 1/p^2, p^3 = p + 1 (M. Roberts, "The unreasonable effectiveness of
 * quasirandom sequences", 2018), in 2^-32, moved by the seed.
 */
static inline void sample_square(uint32_t seed, uint32_t index, float *u, float *v)
{
	*u = sample_unit(index * 3242174889u + sample_hash(seed));
	*v = sample_unit(index * 2447445414u + sample_hash(seed ^ 0x9e3779b9u));
}

/* The bits of a number, the last one first. */
static inline uint32_t sample_reverse(uint32_t x)
{
	x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
	x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
	x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
	x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
	return x >> 16 | x << 16;
}

/* Each bit is exchanged or kept, as a hash of the bits below it says (S. Laine and T. Karras, "Stratified Sampling for
   Stochastic Transparency", 2011; constants after N. Vegdahl, "Building a Better LK Hash", 2021). */
static inline uint32_t sample_mix_upwards(uint32_t x, uint32_t seed)
{
	x ^= x * 0x3d20adeau;
	x += seed;
	x *= seed >> 16 | 1u;
	x ^= x * 0x05526c56u;
	x ^= x * 0x53a22864u;
	return x;
}

/*
 * Point `index` of Sobol's (0,2)-sequence, its digits exchanged as A. Owen has it ("Randomly Permuted (t,m,s)-Nets and
 * (t,s)-Sequences", 1995) and its points in an order of their own, which makes seeds independent of each other (B.
 * Burley, "Practical Hash-based Owen Scrambling", 2020). All points from 0 up to a power of two lie evenly.
 */
static inline void sample_sobol(uint32_t seed, uint32_t index, float *u, float *v)
{
	const uint32_t hash = sample_hash(seed), place = sample_reverse(sample_mix_upwards(sample_reverse(index), hash));
	uint32_t second = place; /* Sobol's matrix of dimension 2, applied by halves: a row is Pascal's triangle modulo 2 */

	second ^= second >> 16;
	second ^= (second & 0xff00ff00u) >> 8;
	second ^= (second & 0xf0f0f0f0u) >> 4;
	second ^= (second & 0xccccccccu) >> 2;
	second ^= (second & 0xaaaaaaaau) >> 1;
	*u = sample_unit(sample_reverse(sample_mix_upwards(place, sample_hash(hash ^ 0x85ebca6bu))));
	*v = sample_unit(sample_reverse(sample_mix_upwards(second, sample_hash(hash ^ 0xc2b2ae35u))));
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

/* Two unit vectors that are at right angles to a unit vector and to each other. */
static inline void sample_basis(struct vec3 n, struct vec3 *a, struct vec3 *b)
{
	struct vec3 other = M_ABS(n.x) < 0.6f ? v3(1.0f, 0.0f, 0.0f) : v3(0.0f, 1.0f, 0.0f);

	*a = v3_normalize(v3_cross(n, other));
	*b = v3_cross(n, *a);
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
