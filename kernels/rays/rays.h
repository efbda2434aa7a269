/*
 * occlude and intersect, each _packet, _wide, _binary and _compressed: trace rays in eye space through a top level and
 * the instances' trees. Included by C and OpenCL C.
 *
 * Triangles are tested after Moeller and Trumbore 1997 ("Fast, minimum storage ray/triangle intersection"), both sides,
 * in the instance's object space, where t keeps its meaning. A hit counts if t_min <= t <= t_max. Triangles without
 * area, triangles seen edge-on (RAYS_FLAT), rays with t_min > t_max and rays with a NaN or an infinite o or d hit
 * nothing. Nor do rays with a component of o / d beyond RAYS_RANGE, in eye space or an instance's (a smaller d counts
 * as 1e-20), because boxes could not be distinguished.
 *
 * Rays that start far from an instance are moved along their direction until they are near it, in its object space. The
 * test's rounding error grows with the distance: at a million times an instance's size, it would report hits that the
 * ray misses by a tenth of that size. With c, r the instance's centre and radius, shift = (c - o).d / d.d - r / max|d|,
 * if shift max|d| > RAYS_FAR r, else 0: o + shift d is a few radii in front of the instance. t is then relative to that
 * point, and the nearest hit of several instances is the one whose rounded t + shift is least.
 *
 * Among nearest hits at exactly the same t, the lowest instance wins, then the lowest primitive, so the answer does not
 * depend on the tree. Rays that continue behind a hit (intersect, after) start at its t and find the next hit in this
 * order, which may be at the same t: a film that lies on a wall does not hide it.
 *
 * Any hit and nearest hit follow one rule: a triangle is tested if the ray itself meets the box of its leaf, regardless
 * of the rays beside it, and both queries test boxes in the same way.
 *
 * Rays to lights (occlude, to_lights) ignore the triangles of an instance that they see from a given side:
 * INSTANCE_PASS_*.
 *
 * Work items: for *_packet, enough for n_rays at RAYS_PER_ITEM each; for all others, n_rays. The caller must skip
 * spaces with nothing to hit (accel_space.n_nodes == 0).
 */
#pragma once

#include "scene/scene.h"
#include "kernels/shared.h"

/* The sides that a walk through an instance ignores: bits INSTANCE_PASS_*; 0: none. */
static inline uint32_t rays_passes(uint32_t flags, uint32_t to_lights)
{
	return to_lights ? flags & (INSTANCE_PASS_COUNTER | INSTANCE_PASS_CLOCKWISE) : 0u;
}

/* The bit for the side of a triangle that a ray sees. determinant: of Moeller and Trumbore, or its inverse */
static inline uint32_t rays_side(float determinant)
{
	return determinant > 0.0f ? INSTANCE_PASS_COUNTER : INSTANCE_PASS_CLOCKWISE;
}

/* Rays per packet, packets per work item. */
#define RAYS_PER_PACKET 16u
#define RAYS_PACKETS 4u
#define RAYS_PER_ITEM (RAYS_PACKETS * RAYS_PER_PACKET)

/* How far a weight may be outside [0,1]: a ray through an edge that two triangles share must not slip between them. */
#define RAYS_EDGE_SLACK 1e-6f

/*
 * A determinant within this share of the product of the largest components of e1, e2 and d is rounding error, and so
 * are the weights and t derived from it. Such a triangle is narrower across the ray than single precision can resolve.
 */
#define RAYS_FLAT 1.5e-6f

#define RAYS_RANGE 1e38f

/* How far beyond the nearest hit boxes are still tested, as a share of its t. */
#define RAYS_END_SLACK 4e-6f

/* Rays that start farther away than this many radii are moved. */
#define RAYS_FAR 64.0f

/* Stack entries for an eight-wide tree: seven siblings per level. */
#define RAYS_WIDE_STACK (7 * BVH_MAX_DEPTH + 1)
