/*
 * Planes of a kd-tree (MacDonald and Booth 1990, "Heuristics for ray tracing using space subdivision"): a cell is cut
 * by the plane with the lowest cost, given the areas of both halves and the number of triangles in each. Triangles that
 * straddle the plane go to both halves, in each with the bounds of their piece ("perfect splits", Wald and Havran 2006,
 * "On building fast kd-trees for ray tracing, and on doing that in O(N log N)", sec. 2.2). Cells shrink to their
 * contents. Large sets of triangles are binned by their two ends (Shevtsov, Soupikov and Kapustin 2007, "Highly
 * parallel fast KD-tree construction for interactive ray tracing of dynamic scenes"); for small sets, every end is a
 * candidate plane. Used by sah_build.inc.
 */
#pragma once

#include "tracer/accel/sbvh_split.h"

#define KD_BINS 32
#define KD_FEW 16 /* with at most this many triangles, every end is tried */

/* Areas of a cell's halves as a plane moves across an axis: end + along * share of the width. */
struct kd_areas {
	float end, along;
};

static inline struct kd_areas kd_areas_of(box8 cell, int axis)
{
	const vec4 size = box8_size(cell);
	const float a = size[(axis + 1) % 3], b = size[(axis + 2) % 3];

	return (struct kd_areas){ a * b, (a + b) * size[axis] };
}

static inline float kd_cost(struct kd_areas areas, float share, uint32_t n_left, uint32_t n_right)
{
	return (areas.end + areas.along * share) * (float)n_left + (areas.end + areas.along * (1 - share)) * (float)n_right;
}

/* Find the cheapest plane between bins of one axis; keep it if cheaper than *best. */
static inline void kd_try_bins(const box8 *refs, uint32_t n, box8 cell, int axis, struct plane *best)
{
	const float lo = -box8_negative_lo(cell)[axis], width = box8_size(cell)[axis], scale = KD_BINS / width;
	const struct kd_areas areas = kd_areas_of(cell, axis);
	uint32_t enter[KD_BINS] = { 0 }, leave[KD_BINS] = { 0 }, n_left = 0, n_right = n;

	if (!(width > 0) || !(scale < FLT_MAX))
		return;
	for (uint32_t i = 0; i < n; i++) {
		const int first = (int)((-box8_negative_lo(refs[i])[axis] - lo) * scale);
		const int last = (int)((box8_hi(refs[i])[axis] - lo) * scale);

		enter[first < KD_BINS ? first : KD_BINS - 1]++;
		leave[last < KD_BINS ? last : KD_BINS - 1]++;
	}
	for (int i = 1; i < KD_BINS; i++) {
		float cost;

		n_left += enter[i - 1];
		n_right -= leave[i - 1];
		cost = kd_cost(areas, (float)i / KD_BINS, n_left, n_right);
		if (n_left && n_right && cost < best->cost)
			*best = (struct plane){ cost, axis, lo + (float)i / scale };
	}
}

/* The same for the planes at both ends of each triangle. */
static inline void kd_try_ends(const box8 *refs, uint32_t n, box8 cell, int axis, struct plane *best)
{
	const float lo = -box8_negative_lo(cell)[axis], width = box8_size(cell)[axis];
	const struct kd_areas areas = kd_areas_of(cell, axis);
	float ends[2 * KD_FEW];

	if (!(width > 0))
		return;
	for (uint32_t i = 0; i < n; i++) {
		ends[2 * i] = -box8_negative_lo(refs[i])[axis];
		ends[2 * i + 1] = box8_hi(refs[i])[axis];
	}
	for (uint32_t k = 0; k < 2 * n; k++) {
		const float at = ends[k];
		uint32_t n_left = 0, n_right = 0;
		float cost;

		for (uint32_t i = 0; i < n; i++) { /* same rule as partition_space */
			n_left += ends[2 * i] < at || ends[2 * i + 1] <= at;
			n_right += ends[2 * i + 1] > at;
		}
		cost = kd_cost(areas, (at - lo) / width, n_left, n_right);
		if (n_left && n_right && cost < best->cost)
			*best = (struct plane){ cost, axis, at };
	}
}

static inline struct plane find_kd_plane(const box8 *refs, uint32_t n, box8 cell)
{
	struct plane best = { FLT_MAX, 0, 0 };

	for (int axis = 0; axis < 3; axis++)
		if (n <= KD_FEW)
			kd_try_ends(refs, n, cell, axis, &best);
		else
			kd_try_bins(refs, n, cell, axis, &best);
	return best;
}

/* Count the references that a plane cuts. */
static inline uint32_t kd_count_cut(const box8 *refs, uint32_t n, const struct plane *plane)
{
	uint32_t cut = 0;

	for (uint32_t i = 0; i < n; i++)
		cut += -box8_negative_lo(refs[i])[plane->axis] < plane->at && box8_hi(refs[i])[plane->axis] > plane->at;
	return cut;
}
