/*
 * Sixteen rays, one per lane, against eight-wide trees, one box or triangle at a time. OpenCL C only; included by
 * occlude_packet and intersect_packet.
 *
 * Boxes: with i = 1/d, a ray meets a plane at p at t = p * i - o * i. Both products are kept in two roundings, so that
 * rounding misses no box (far planes with p * i < 0 come nearer because i is larger; o * i makes up for it). Only the
 * signs of d determine which of a box's planes comes first; if they differ within a packet, each lane selects its own.
 * A ray is asleep if t_max is below t_min.
 */
#pragma once

#include "scene/scene.h"
#include "kernels/shared.h"
#include "kernels/rays/rays.h"
#include "kernels/rays/lanes.h"

/* Sixteen rays in the space of the tree they walk. */
struct packet {
	packf ox, oy, oz, dx, dy, dz;
	packf ix, iy, iz;                      /* 1/d, finite */
	packf far_ix, far_iy, far_iz;          /* the same rounded away from 0 */
	packf near_x, near_y, near_z;          /* rounded down: added to near planes */
	packf far_x, far_y, far_z;             /* rounded up: added to far planes */
	packf t_min, t_max;
};

static inline packf pack_invert(packf d)
{
	return 1.0f / select(copysign((packf)(1e-20f), d), d, fabs(d) > 1e-20f);
}

/* Set the members that follow from o and d. */
static inline void packet_prepare(struct packet *p)
{
	const packf ix = pack_invert(p->dx), iy = pack_invert(p->dy), iz = pack_invert(p->dz);
	const packf bx = -p->ox * ix, by = -p->oy * iy, bz = -p->oz * iz;

	p->ix = ix, p->iy = iy, p->iz = iz;
	p->far_ix = ix * (1 + 6e-7f), p->far_iy = iy * (1 + 6e-7f), p->far_iz = iz * (1 + 6e-7f);
	p->near_x = bx - fabs(bx) * 3e-7f, p->near_y = by - fabs(by) * 3e-7f, p->near_z = bz - fabs(bz) * 3e-7f;
	p->far_x = bx + fabs(bx) * 1.5e-6f, p->far_y = by + fabs(by) * 1.5e-6f, p->far_z = bz + fabs(bz) * 1.5e-6f;
}

/* The lanes whose distances to boxes are finite numbers. */
static inline packi packet_in_range(const struct packet *p)
{
	return (fabs(p->ox * p->ix) < RAYS_RANGE) & (fabs(p->oy * p->iy) < RAYS_RANGE) & (fabs(p->oz * p->iz) < RAYS_RANGE);
}

/* Transform o and d from eye to object space. */
static inline void packet_transform(struct packet *p, const struct packet *eye, __global const float *m)
{
	p->ox = fma(m[2], eye->oz, fma(m[1], eye->oy, fma(m[0], eye->ox, m[3])));
	p->oy = fma(m[6], eye->oz, fma(m[5], eye->oy, fma(m[4], eye->ox, m[7])));
	p->oz = fma(m[10], eye->oz, fma(m[9], eye->oy, fma(m[8], eye->ox, m[11])));
	p->dx = fma(m[2], eye->dz, fma(m[1], eye->dy, m[0] * eye->dx));
	p->dy = fma(m[6], eye->dz, fma(m[5], eye->dy, m[4] * eye->dx));
	p->dz = fma(m[10], eye->dz, fma(m[9], eye->dy, m[8] * eye->dx));
}

/* The signs of the directions, 1 bit each, per lane. */
static inline packi packet_octants(const struct packet *p)
{
	return (as_int16(p->ix) >> 31 & 1) | (as_int16(p->iy) >> 31 & 2) | (as_int16(p->iz) >> 31 & 4);
}

/* Offsets in a node8 of the rows of the near and far planes for an octant. */
struct planes {
	uint near_x, near_y, near_z, far_x, far_y, far_z;
};

static inline struct planes octant_planes(int octant)
{
	struct planes s;

	s.near_x = octant & 1 ? 24 : 0, s.far_x = 24 - s.near_x;
	s.near_y = octant & 2 ? 32 : 8, s.far_y = 40 - s.near_y;
	s.near_z = octant & 4 ? 40 : 16, s.far_z = 56 - s.near_z;
	return s;
}

/* Limit for box tests: walk_end of kernels/rays/walk.h. For a finished ray (t_max -infinity) it is NaN, so that the ray
 * meets no box. */
static inline packf packet_end(const struct packet *p)
{
	return fma(fabs(p->t_max), RAYS_END_SLACK, p->t_max);
}

/* Lanes that meet a node's box before `end`, all with the same octant. bounds: the node's first float of that box. */
static inline packi packet_meets(const struct packet *p, packf end, __global const float *bounds, struct planes s)
{
	const packf enter = pack_max(
		pack_max(fma(bounds[s.near_x], p->ix, p->near_x), fma(bounds[s.near_y], p->iy, p->near_y)),
		pack_max(fma(bounds[s.near_z], p->iz, p->near_z), p->t_min));
	const packf leave = pack_min(
		pack_min(fma(bounds[s.far_x], p->far_ix, p->far_x), fma(bounds[s.far_y], p->far_iy, p->far_y)),
		pack_min(fma(bounds[s.far_z], p->far_iz, p->far_z), end));

	return enter <= leave;
}

/*
 * Bounds of the rays of a packet with a single octant: per axis, the corner of their origins that enters a box first,
 * the one that leaves it last, and the least and greatest 1/d. No ray meets a box that the beam misses (interval
 * arithmetic: Reshetov, Soupikov and Hurley 2005, "Multi-level ray tracing algorithm"). A beam tests eight boxes at
 * once, however many rays there are.
 */
struct beam {
	float near_o[3], far_o[3], least[3], greatest[3], t_min, t_max;
};

static inline float least_of(packf x)
{
	const float8 eight = lanes_min(x.lo, x.hi);
	const float4 four = select(eight.hi, eight.lo, eight.lo < eight.hi);

	return fmin(fmin(four.x, four.y), fmin(four.z, four.w));
}

static inline float sum_of(packf x)
{
	const float8 eight = x.lo + x.hi;
	const float4 four = eight.lo + eight.hi;

	return four.x + four.y + (four.z + four.w);
}

/* Bounds of a value over the awake rays of n packets: the least value, and the least of the negated values. */
struct bounds {
	packf least, opposite;
};

static inline void bounds_add(struct bounds *b, packf x, packi awake)
{
	b->least = pack_min(b->least, select((packf)(INFINITY), x, awake));
	b->opposite = pack_min(b->opposite, select((packf)(INFINITY), -x, awake));
}

static inline struct beam beam_around(const struct packet *p, uint n, int octant)
{
	struct bounds bounds[8];
	struct beam b;

	for (int i = 0; i < 8; i++)
		bounds[i].least = bounds[i].opposite = INFINITY;
	for (uint k = 0; k < n; k++) {
		const packi awake = p[k].t_min <= p[k].t_max;

		bounds_add(&bounds[0], p[k].ox, awake), bounds_add(&bounds[1], p[k].oy, awake),
			bounds_add(&bounds[2], p[k].oz, awake);
		bounds_add(&bounds[3], p[k].ix, awake), bounds_add(&bounds[4], p[k].iy, awake),
			bounds_add(&bounds[5], p[k].iz, awake);
		bounds_add(&bounds[6], p[k].t_min, awake), bounds_add(&bounds[7], packet_end(&p[k]), awake);
	}
	for (int axis = 0; axis < 3; axis++) {
		const float least = least_of(bounds[axis].least), greatest = -least_of(bounds[axis].opposite);
		const float size = fmax(fabs(least), fabs(greatest)), sign = octant >> axis & 1 ? -1 : 1;

		/* With the same slack as packet_meets, so that no ray depends on its neighbours. */
		b.near_o[axis] = fma(sign * size, 5e-7f, sign > 0 ? greatest : least);
		b.far_o[axis] = fma(sign * size, -2.5e-6f, sign > 0 ? least : greatest);
		b.least[axis] = least_of(bounds[3 + axis].least);
		b.greatest[axis] = -least_of(bounds[3 + axis].opposite);
	}
	b.t_min = least_of(bounds[6].least);
	b.t_max = -least_of(bounds[7].opposite);
	return b;
}

static inline float8 beam_enters(const struct beam *b, int axis, float8 plane)
{
	const float8 d = plane - b->near_o[axis];

	return lanes_min(d * b->least[axis], d * b->greatest[axis]);
}

static inline float8 beam_leaves(const struct beam *b, int axis, float8 plane)
{
	const float8 d = plane - b->far_o[axis];

	return lanes_max(d * b->least[axis], d * b->greatest[axis]);
}

/* A bit for each of a node's boxes that rays of the beam may meet. Slack for rounding is relative to each term. */
static inline uint beam_meets(const struct beam *b, __global const struct node8 *node, struct planes s)
{
	__global const float *rows = (__global const float *)node;
	const float8 x = beam_enters(b, 0, vload8(0, rows + s.near_x)), y = beam_enters(b, 1, vload8(0, rows + s.near_y));
	const float8 z = beam_enters(b, 2, vload8(0, rows + s.near_z));
	const float8 u = beam_leaves(b, 0, vload8(0, rows + s.far_x)), v = beam_leaves(b, 1, vload8(0, rows + s.far_y));
	const float8 w = beam_leaves(b, 2, vload8(0, rows + s.far_z));
	const float8 enter = lanes_max(lanes_max(x, y), lanes_max(z, b->t_min));
	const float8 leave = lanes_min(lanes_min(u, v), lanes_min(w, b->t_max));

	return lane_bits(enter <= fma(fabs(leave), 3e-6f, leave));
}

/* The same for any mix of octants. */
static inline packi packet_meets_any(const struct packet *p, packf end, __global const struct node8 *node, uint side)
{
	const packf lo_x = node->lo[0][side], hi_x = node->hi[0][side], lo_y = node->lo[1][side], hi_y = node->hi[1][side];
	const packf lo_z = node->lo[2][side], hi_z = node->hi[2][side];
	const packi x = p->ix < 0, y = p->iy < 0, z = p->iz < 0;
	const packf enter = pack_max(
		pack_max(fma(select(lo_x, hi_x, x), p->ix, p->near_x), fma(select(lo_y, hi_y, y), p->iy, p->near_y)),
		pack_max(fma(select(lo_z, hi_z, z), p->iz, p->near_z), p->t_min));
	const packf leave = pack_min(pack_min(fma(select(hi_x, lo_x, x), p->far_ix, p->far_x),
	                                      fma(select(hi_y, lo_y, y), p->far_iy, p->far_y)),
	                             pack_min(fma(select(hi_z, lo_z, z), p->far_iz, p->far_z), end));

	return enter <= leave;
}

/* The octant of all awake lanes of n packets; -1: there are several. */
static inline int packet_octant(const struct packet *p, uint n)
{
	packi all = -1, some = 0;
	int octant = 0;

	for (uint k = 0; k < n; k++) {
		const packi awake = p[k].t_min <= p[k].t_max, octants = packet_octants(&p[k]);

		all &= octants | ~awake;
		some |= octants & awake;
	}
	for (int bit = 1; bit < 8; bit <<= 1) {
		const int set = any_pack((some & bit) != 0), clear = any_pack((all & bit) == 0);

		if (set && clear)
			return -1;
		octant |= set ? bit : 0;
	}
	return octant;
}

/* The lanes, out of a set, that do not see a triangle edge-on. */
static inline packi packet_faces(const struct packet *p, __global const struct triangle8 *block, uint lane,
                                 packf inverse)
{
	const float e1 = fmax(fmax(fabs(block->e1[0][lane]), fabs(block->e1[1][lane])), fabs(block->e1[2][lane]));
	const float e2 = fmax(fmax(fabs(block->e2[0][lane]), fabs(block->e2[1][lane])), fabs(block->e2[2][lane]));

	return RAYS_FLAT * e1 * e2 * (pack_max(pack_max(fabs(p->dx), fabs(p->dy)), fabs(p->dz)) * fabs(inverse)) < 1.0f;
}

/*
 * Moeller and Trumbore: the lanes, out of a set, with a hit at t in t_min .. t_max, and its position. passes: as
 * rays_passes
 */
static inline packi packet_triangle(const struct packet *p, uint lanes, uint passes,
                                    __global const struct triangle8 *block, uint lane, packf *t_out, packf *b1,
                                    packf *b2)
{
	const float e1x = block->e1[0][lane], e1y = block->e1[1][lane], e1z = block->e1[2][lane];
	const float e2x = block->e2[0][lane], e2y = block->e2[1][lane], e2z = block->e2[2][lane];
	const packf px = fma(p->dy, e2z, -(p->dz * e2y));
	const packf py = fma(p->dz, e2x, -(p->dx * e2z));
	const packf pz = fma(p->dx, e2y, -(p->dy * e2x));
	const packf inverse = 1.0f / fma(e1z, pz, fma(e1y, py, e1x * px));
	const packf sx = p->ox - block->v0[0][lane], sy = p->oy - block->v0[1][lane], sz = p->oz - block->v0[2][lane];
	const packf u = fma(sz, pz, fma(sy, py, sx * px)) * inverse;
	const packf qx = fma(sy, e1z, -(sz * e1y));
	const packf qy = fma(sz, e1x, -(sx * e1z));
	const packf qz = fma(sx, e1y, -(sy * e1x));
	const packf v = fma(p->dz, qz, fma(p->dy, qy, p->dx * qx)) * inverse;
	const packf t = fma(e2z, qz, fma(e2y, qy, e2x * qx)) * inverse;

	packi hit = (u >= -RAYS_EDGE_SLACK) & (v >= -RAYS_EDGE_SLACK) & (u + v <= 1 + RAYS_EDGE_SLACK) & (t >= p->t_min) &
	            (t <= p->t_max);

	if (any_pack(hit)) {
		hit &= packet_faces(p, block, lane, inverse) & lanes_pack(lanes);
		if (passes)
			hit &= passes == INSTANCE_PASS_COUNTER ? inverse < 0.0f : inverse > 0.0f;
	}
	*t_out = t, *b1 = u, *b2 = v;
	return hit;
}
