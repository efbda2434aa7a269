/*
 * Samples that do not depend on when or where they are taken: a sequence that fills the unit square evenly, turned by a
 * number of each pixel and purpose.
 */
#ifndef KERNELS_SAMPLE_H
#define KERNELS_SAMPLE_H

#include "kernels/common.h"

/* What a sample is for: neighbours in this list share nothing. */
#define SAMPLE_LIGHT 0x10000u /* + slot of the light */
#define SAMPLE_BOUNCE 0x20000u
#define SAMPLE_CHOICE 0x30000u
#define SAMPLE_GLOSS 0x40000u
#define SAMPLE_JITTER 0x50000u

/* Mix the bits of a number: multiply, shift and xor (constants found by C. Wellons, "Prospecting for hash functions"). */
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

#endif
