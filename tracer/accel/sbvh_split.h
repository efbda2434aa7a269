/*
 * Spatial splits (Stich, Friedrich and Dietrich 2009, "Spatial splits in bounding volume hierarchies"): if the sides of
 * the best division of a part still overlap, a plane cuts its space instead. Triangles that straddle the plane are in
 * both sides, in each with the bounds of their piece. Used by sah_build.inc.
 */
#pragma once

#include <float.h>
#include <math.h>

#include "kernels/rays/rays.h"
#include "tracer/accel/sah_part.h"

#define SPATIAL_BINS 16
/* Space is cut only if the sides overlap by at least this share of the root's area (Stich et al. sec. 4.5; 1e-5 takes a
 * quarter more time here). */
#define SPATIAL_OVERLAP 1e-4f

/* Bounds of the pieces inside a bin; how many items begin and end in it. */
struct spatial_bin {
	box8 box;
	uint32_t enter, leave;
};

/* A plane that cuts space. */
struct plane {
	float cost; /* as in struct split; FLT_MAX: none */
	int axis;
	float at;
};

static inline box8 box8_meet(box8 a, box8 b)
{
	return box8_make(vec4_min(box8_negative_lo(a), box8_negative_lo(b)), vec4_min(box8_hi(a), box8_hi(b)));
}

/* The reference of a piece: its own box, with the item of the whole. */
static inline box8 piece_of(box8 piece, box8 whole)
{
	const ivec4 item = { 0, 0, 0, -1 }, lo = (ivec4)box8_negative_lo(box8_meet(piece, whole));

	return box8_make((vec4)((lo & ~item) | ((ivec4)box8_negative_lo(whole) & item)), box8_hi(box8_meet(piece, whole)));
}

static inline vec4 set_lane(vec4 v, int axis, float x)
{
	v[axis] = x;
	return v;
}

/*
 * Compute the boxes of the two pieces of a triangle, within the box of the piece being cut. They are widened by the hit
 * tolerance at a triangle's edges, as boxes are in soup.c.
 */
static inline void cut_triangle(const struct triangle *t, box8 whole, int axis, float at, box8 *left, box8 *right)
{
	const vec4 v0 = { t->v0[0], t->v0[1], t->v0[2], 0 }, e1 = { t->e1[0], t->e1[1], t->e1[2], 0 };
	const vec4 e2 = { t->e2[0], t->e2[1], t->e2[2], 0 };
	const vec4 v[3] = { v0, v0 + e1, v0 + e2 };
	box8 l = box8_empty(), r = l;
	vec4 pad;

	for (int i = 0; i < 3; i++) {
		const vec4 p = v[i], q = v[(i + 1) % 3];
		const float pa = p[axis], qa = q[axis];

		if (pa <= at)
			l = box8_join(box8_make(-p, p), l);
		if (pa >= at)
			r = box8_join(box8_make(-p, p), r);
		if ((pa < at && qa > at) || (pa > at && qa < at)) {
			const vec4 c = set_lane(p + (q - p) * VEC4((at - pa) / (qa - pa)), axis, at);

			l = box8_join(box8_make(-c, c), l);
			r = box8_join(box8_make(-c, c), r);
		}
	}
	pad = RAYS_EDGE_SLACK * (vec4_max(e1, -e1) + vec4_max(e2, -e2)) +
	      2.5e-7f * vec4_max(vec4_max(box8_hi(whole), -box8_hi(whole)),
	                         vec4_max(box8_negative_lo(whole), -box8_negative_lo(whole)));
	*left = piece_of(box8_make(box8_negative_lo(l) + pad, box8_hi(l) + pad), whole);
	*right = piece_of(box8_make(box8_negative_lo(r) + pad, box8_hi(r) + pad), whole);
}

/* Is the box non-empty? Ignores the fourth lanes. */
static inline int box8_is_box(box8 b)
{
	const vec4 size = box8_size(b);

	return size[0] >= 0 && size[1] >= 0 && size[2] >= 0;
}

static inline int spatial_bin_of(float x, float lo, float scale)
{
	const int bin = (int)((x - lo) * scale);

	return bin < 0 ? 0 : bin >= SPATIAL_BINS ? SPATIAL_BINS - 1 : bin;
}

/* Find the cheapest plane across one axis; keep it if cheaper than *best. */
static inline void try_planes(const struct triangle *triangles, const box8 *refs, uint32_t n, box8 space, int axis,
                              struct plane *best)
{
	const float lo = -box8_negative_lo(space)[axis], width = box8_size(space)[axis], scale = SPATIAL_BINS / width;
	struct spatial_bin bins[SPATIAL_BINS];
	float right_cost[SPATIAL_BINS];
	box8 side = box8_empty();
	uint32_t count = 0;

	if (!(width > 0) || !(scale < FLT_MAX))
		return;
	for (int i = 0; i < SPATIAL_BINS; i++)
		bins[i] = (struct spatial_bin){ side, 0, 0 };
	for (uint32_t i = 0; i < n; i++) {
		const int first = spatial_bin_of(-box8_negative_lo(refs[i])[axis], lo, scale);
		const int last = spatial_bin_of(box8_hi(refs[i])[axis], lo, scale);
		box8 rest = refs[i];

		bins[first].enter++;
		bins[last].leave++;
		for (int k = first; k < last; k++) {
			box8 piece;

			cut_triangle(&triangles[sah_item_of(refs[i])], rest, axis, lo + (float)(k + 1) / scale, &piece, &rest);
			if (box8_is_box(piece))
				bins[k].box = box8_join(piece, bins[k].box);
			if (!box8_is_box(rest))
				break;
		}
		if (box8_is_box(rest))
			bins[last].box = box8_join(rest, bins[last].box);
	}
	for (int i = SPATIAL_BINS - 1; i > 0; i--) {
		side = box8_join(bins[i].box, side);
		count += bins[i].leave;
		right_cost[i] = count ? box8_half_area(side) * (float)count : FLT_MAX;
	}
	side = box8_empty();
	count = 0;
	for (int i = 1; i < SPATIAL_BINS; i++) {
		float cost;

		side = box8_join(bins[i - 1].box, side);
		count += bins[i - 1].enter;
		cost = count && right_cost[i] < FLT_MAX ? box8_half_area(side) * (float)count + right_cost[i] : FLT_MAX;
		if (cost < best->cost)
			*best = (struct plane){ cost, axis, lo + (float)i / scale };
	}
}

static inline struct plane find_plane(const struct triangle *triangles, const box8 *refs, uint32_t n, box8 space)
{
	struct plane best = { FLT_MAX, 0, 0 };

	for (int axis = 0; axis < 3; axis++)
		try_planes(triangles, refs, n, space, axis, &best);
	return best;
}

/*
 * Sort references to both sides of a plane: first those of the left side, then those of the right, up to `room` in all.
 * A triangle that straddles the plane goes to both or, with may_keep, whole to one side if that is cheaper (Stich et
 * al. sec. 4.4). Sets count and box of both parts.
 * @return 1; 0 if one side would be empty: refs then has the same references in another order
 */
static inline int partition_space(const struct triangle *triangles, box8 *refs, uint32_t n, uint32_t room,
                                  const struct plane *plane, int may_keep, struct sah_part *left,
                                  struct sah_part *right)
{
	box8 l = box8_empty(), r = l;
	uint32_t n_left = 0, n_right = 0, n_cut, total = n;

	/* Left, cut, right. */
	for (uint32_t i = 0; i + n_right < n;) {
		const box8 ref = refs[i];

		if (box8_hi(ref)[plane->axis] <= plane->at) {
			l = box8_join(ref, l);
			refs[i++] = refs[n_left];
			refs[n_left++] = ref;
		} else if (-box8_negative_lo(ref)[plane->axis] >= plane->at) {
			r = box8_join(ref, r);
			refs[i] = refs[n - ++n_right];
			refs[n - n_right] = ref;
		} else {
			i++;
		}
	}
	n_cut = n - n_left - n_right;
	/* Counts if every straddling triangle were cut. */
	n_right += n_cut;
	n_left += n_cut;
	for (uint32_t i = n - n_right; n_cut; n_cut--) {
		const box8 ref = refs[i];
		box8 a, b, la, rb;
		float both, whole_left, whole_right;

		cut_triangle(&triangles[sah_item_of(ref)], ref, plane->axis, plane->at, &a, &b);
		la = box8_join(ref, l);
		rb = box8_join(ref, r);
		whole_left = box8_half_area(la) * (float)n_left + (n_right > 1 ? box8_half_area(r) * (float)(n_right - 1) : 0);
		whole_right = (n_left > 1 ? box8_half_area(l) * (float)(n_left - 1) : 0) + box8_half_area(rb) * (float)n_right;
		both = box8_is_box(a) && box8_is_box(b) && total < room
			? box8_half_area(box8_join(a, l)) * (float)n_left + box8_half_area(box8_join(b, r)) * (float)n_right : FLT_MAX;
		if (both < FLT_MAX && (!may_keep || (both < whole_left && both < whole_right))) {
			refs[i++] = a;
			refs[total++] = b;
			l = box8_join(a, l);
			r = box8_join(b, r);
		} else if (whole_left <= whole_right) {
			l = la;
			n_right--;
			i++;
		} else {
			/* Move it after the references that are still to be cut. */
			refs[i] = refs[i + n_cut - 1];
			refs[i + n_cut - 1] = ref;
			r = rb;
			n_left--;
		}
	}
	left->count = n_left;
	right->count = n_right;
	left->box = l;
	right->box = r;
	return n_left && n_right;
}
