/*
 * occlude and intersect, each _packet, _wide, _binary and _compressed: rays in eye space against a top level and the
 * instances' trees. Included by C and OpenCL C.
 *
 * Triangles are tested after Moeller and Trumbore 1997 ("Fast, minimum storage ray/triangle intersection"), both sides,
 * in the instance's object space, where t keeps its meaning. A hit counts where t_min <= t <= t_max. Triangles without
 * area, triangles seen edge-on (RAYS_FLAT), rays with t_min > t_max and rays with a NaN or an infinite o or d hit
 * nothing. Nor do rays with a component of o / d beyond RAYS_RANGE, in eye space or an instance's (a smaller d counts
 * as 1e-20): boxes could not be told apart.
 *
 * Rays that start far from an instance are moved along themselves until they are near it, in its object space: the test
 * rounds in proportion to the distance, and at a million times an instance's size would hit what the ray misses by a
 * tenth of it. With c, r the instance's centre and radius, shift = (c - o).d / d.d - r / max|d|, where shift max|d| >
 * RAYS_FAR r, else 0: o + shift d is a few radii before the instance. There t is counted from that point; the nearest
 * hit of several instances is the one whose t + shift, rounded, is least.
 *
 * Of several nearest hits at the very same t the lowest instance counts, there the lowest primitive: the answer depends
 * on no tree.
 *
 * Any hit and nearest hit decide by one rule: a triangle is tried where the ray itself meets the box of its leaf,
 * whatever rays travel beside it, and both queries ask the boxes in the same way.
 *
 * Rays to lights (occlude, to_lights) pass the triangles of an instance that they see from one side: INSTANCE_PASS_*.
 *
 * Work items: as many as hold n_rays when each takes RAYS_PER_ITEM for *_packet, n_rays for all others. A space with
 * nothing to hit (accel_space.n_nodes == 0) is the caller's to leave out.
 */
#pragma once

#include "scene/scene.h"
#include "kernels/shared.h"

/* What a walk through an instance passes: bits INSTANCE_PASS_*; 0: nothing. */
static inline uint32_t rays_passes(uint32_t flags, uint32_t to_lights)
{
	return to_lights ? flags & (INSTANCE_PASS_COUNTER | INSTANCE_PASS_CLOCKWISE) : 0u;
}

/* The bit for the side of a triangle that a ray sees. determinant: of Moeller and Trumbore, or its inverse */
static inline uint32_t rays_side(float determinant)
{
	return determinant > 0.0f ? INSTANCE_PASS_COUNTER : INSTANCE_PASS_CLOCKWISE;
}

/* Rays in a packet, packets of a work item. */
#define RAYS_PER_PACKET 16u
#define RAYS_PACKETS 4u
#define RAYS_PER_ITEM (RAYS_PACKETS * RAYS_PER_PACKET)

/* By how much a weight may leave [0,1]: a ray through an edge that two triangles share must not slip between them. */
#define RAYS_EDGE_SLACK 1e-6f

/*
 * A determinant within this share of the largest components of e1, e2 and d, multiplied, is rounding, and so are the
 * weights and t that come of it. Such a triangle is narrower across the ray than single precision can tell.
 */
#define RAYS_FLAT 1.5e-6f

#define RAYS_RANGE 1e38f

/* How much farther than the nearest hit boxes are looked at, as a share of its t. */
#define RAYS_END_SLACK 4e-6f

/* From how many radii on a ray is moved. */
#define RAYS_FAR 64.0f

/* Entries of a stack over an eight-wide tree: seven siblings a level. */
#define RAYS_WIDE_STACK (7 * BVH_MAX_DEPTH + 1)
