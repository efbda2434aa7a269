/*
 * Judges answers of queries by testing all triangles in double precision, with other arithmetic than the kernels'.
 * Differences that single precision cannot resolve count as right: `band` is ROUNDING times 2^-24 times the largest
 * coordinate involved.
 */
#pragma once

#include "verbs/query/relume-rays.h"

#define BRUTE_ROUNDING 64

struct brute {
	const float (*position)[3];
	const uint32_t (*index)[3];
	uint32_t n;
	double extent; /* largest coordinate of a vertex */
};

/* Each returns whether an answer is right. `sampled`: 1: also sample a box's path, which is slower. */
int brute_nearest(const struct brute *b, const struct relume_rays_ray *ray, const struct relume_rays_hit *hit);
int brute_any(const struct brute *b, const struct relume_rays_ray *ray, uint32_t any);
/** @param kept  number of hits returned, out of `count` */
int brute_all(const struct brute *b, const struct relume_rays_ray *ray, const struct relume_rays_hit *hits,
              uint32_t kept, uint32_t count);
int brute_distance(const struct brute *b, const struct relume_rays_point *point,
                   const struct relume_rays_distance *answer);
int brute_box(const struct brute *b, const struct relume_rays_body *body, const struct relume_rays_contact *contact,
              int sampled);
int brute_sphere(const struct brute *b, const struct relume_rays_body *body, const struct relume_rays_contact *contact);
