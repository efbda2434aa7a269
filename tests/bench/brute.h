/*
 * Answers of queries judged by all triangles, one by one, in double precision, by other arithmetic than the kernels'.
 * What single precision cannot tell apart counts as right: `band` is ROUNDING times 2^-24 times the largest coordinate
 * in question.
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

/* Each says whether an answer is right. `sampled`: 1: the slower look at moments of a box's way, too. */
int brute_nearest(const struct brute *b, const struct relume_rays_ray *ray, const struct relume_rays_hit *hit);
int brute_any(const struct brute *b, const struct relume_rays_ray *ray, uint32_t any);
/** @param kept  hits that were given, of `count` */
int brute_all(const struct brute *b, const struct relume_rays_ray *ray, const struct relume_rays_hit *hits,
              uint32_t kept, uint32_t count);
int brute_distance(const struct brute *b, const struct relume_rays_point *point,
                   const struct relume_rays_distance *answer);
int brute_box(const struct brute *b, const struct relume_rays_body *body, const struct relume_rays_contact *contact,
              int sampled);
int brute_sphere(const struct brute *b, const struct relume_rays_body *body, const struct relume_rays_contact *contact);
