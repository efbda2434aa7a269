/*
 * Sixteen rays as rows of a lane each against binary trees. OpenCL C only; included by the packet kernels.
 *
 * Boxes: with i = 1/d, a plane at p is met at t = p * i - o * i. Both products are kept in two roundings, so that no box is
 * missed by rounding (far planes with p * i < 0 come nearer by what i is made larger; o * i gives that back). Which of a
 * box's planes is met first depends on the signs of d alone: a packet whose rays differ in signs is walked once for
 * each octant, the other lanes asleep (t_max below t_min).
 */
#ifndef KERNELS_PACKET_H
#define KERNELS_PACKET_H

#include "replay/scene.h"
#include "kernels/shared.h"
#include "kernels/rays.h"
#include "kernels/lanes.h"

/* Sixteen rays in the space of the tree they walk. */
struct packet {
	packf ox, oy, oz, dx, dy, dz;
	packf ix, iy, iz;                      /* 1/d, finite */
	packf far_ix, far_iy, far_iz;          /* the same rounded away from 0 */
	packf near_x, near_y, near_z;          /* rounded down: what is added to near planes */
	packf far_x, far_y, far_z;             /* and up, to far planes */
	packf t_min, t_max;
};

inline packf invert(packf d)
{
	return 1.0f / select(copysign((packf)(1e-20f), d), d, fabs(d) > 1e-20f);
}

/* Fill in what follows from o and d. */
inline void packet_prepare(struct packet *p)
{
	const packf ix = invert(p->dx), iy = invert(p->dy), iz = invert(p->dz);
	const packf bx = -p->ox * ix, by = -p->oy * iy, bz = -p->oz * iz;

	p->ix = ix, p->iy = iy, p->iz = iz;
	p->far_ix = ix * (1 + 6e-7f), p->far_iy = iy * (1 + 6e-7f), p->far_iz = iz * (1 + 6e-7f);
	p->near_x = bx - fabs(bx) * 3e-7f, p->near_y = by - fabs(by) * 3e-7f, p->near_z = bz - fabs(bz) * 3e-7f;
	p->far_x = bx + fabs(bx) * 1.5e-6f, p->far_y = by + fabs(by) * 1.5e-6f, p->far_z = bz + fabs(bz) * 1.5e-6f;
}

/* o and d moved from eye to object space. */
inline void packet_transform(struct packet *p, const struct packet *eye, __global const float *m)
{
	p->ox = fma(m[2], eye->oz, fma(m[1], eye->oy, fma(m[0], eye->ox, m[3])));
	p->oy = fma(m[6], eye->oz, fma(m[5], eye->oy, fma(m[4], eye->ox, m[7])));
	p->oz = fma(m[10], eye->oz, fma(m[9], eye->oy, fma(m[8], eye->ox, m[11])));
	p->dx = fma(m[2], eye->dz, fma(m[1], eye->dy, m[0] * eye->dx));
	p->dy = fma(m[6], eye->dz, fma(m[5], eye->dy, m[4] * eye->dx));
	p->dz = fma(m[10], eye->dz, fma(m[9], eye->dy, m[8] * eye->dx));
}

/* Per lane, 1 bit each: the signs of the directions. */
inline packi packet_octants(const struct packet *p)
{
	return (as_int16(p->ix) >> 31 & 1) | (as_int16(p->iy) >> 31 & 2) | (as_int16(p->iz) >> 31 & 4);
}

/* Where in a node2 the planes lie that an octant meets first and last: number of the float for x y z of side 0. */
struct planes {
	uint near_x, near_y, near_z, far_x, far_y, far_z;
};

inline struct planes octant_planes(int octant)
{
	struct planes s;

	s.near_x = octant & 1 ? 6 : 0, s.far_x = 6 - s.near_x;
	s.near_y = octant & 2 ? 7 : 1, s.far_y = 8 - s.near_y;
	s.near_z = octant & 4 ? 8 : 2, s.far_z = 10 - s.near_z;
	return s;
}

/* Where the rays enter and leave the box of one side (0 or 1) of a node: enter <= leave where they meet it. */
inline packf packet_enter(const struct packet *p, __global const float *node, struct planes s, uint side)
{
	return pack_max(pack_max(fma(node[s.near_x + 3 * side], p->ix, p->near_x), fma(node[s.near_y + 3 * side], p->iy, p->near_y)),
	            pack_max(fma(node[s.near_z + 3 * side], p->iz, p->near_z), p->t_min));
}

inline packf packet_leave(const struct packet *p, __global const float *node, struct planes s, uint side)
{
	return pack_min(pack_min(fma(node[s.far_x + 3 * side], p->far_ix, p->far_x), fma(node[s.far_y + 3 * side], p->far_iy, p->far_y)),
	            pack_min(fma(node[s.far_z + 3 * side], p->far_iz, p->far_z), p->t_max));
}

/* Lanes that meet the box of one side, whatever their octants: for top levels, which are small. */
inline packi packet_meets_box(const struct packet *p, __global const struct node2 *node, uint side)
{
	const packf x0 = node->lo[side][0] * p->ix, x1 = node->hi[side][0] * p->ix;
	const packf y0 = node->lo[side][1] * p->iy, y1 = node->hi[side][1] * p->iy;
	const packf z0 = node->lo[side][2] * p->iz, z1 = node->hi[side][2] * p->iz;
	const packf enter = pack_max(pack_max(pack_min(x0, x1) + p->near_x, pack_min(y0, y1) + p->near_y),
	                          pack_max(pack_min(z0, z1) + p->near_z, p->t_min));
	const packf leave = pack_min(pack_min(pack_max(x0, x1) + p->far_x, pack_max(y0, y1) + p->far_y),
	                          pack_min(pack_max(z0, z1) + p->far_z, p->t_max));

	return (enter <= leave) & (packi)(node->lo[side][0] <= node->hi[side][0] ? -1 : 0);
}

/* The lanes of a packet octant by octant: those awake in the first awake lane's octant, and they fall asleep. */
inline packi packet_next_octant(packi octants, packi *awake, int *octant)
{
	packi lanes;

	*octant = 0;
	for (uint i = 0; i < RAYS_PER_PACKET; i++)
		if (((const int *)awake)[i]) {
			*octant = ((const int *)&octants)[i];
			break;
		}
	lanes = *awake & (octants == *octant);
	*awake &= ~lanes;
	return lanes;
}

/* A subtree to be walked, and where the rays enter it. */
struct packet_entry {
	packf enter;
	uint child, count;
};

/* What a packet found, per lane. */
struct packet_hits {
	packf b1, b2;
	packu instance, primitive;
};

/* Moeller and Trumbore: lanes hit at t in t_min .. t_max; b1, b2 of all lanes. */
inline packi packet_triangle(const struct packet *p, __global const struct triangle *tri, packf *t, packf *b1,
                            packf *b2)
{
	const float e1x = tri->e1[0], e1y = tri->e1[1], e1z = tri->e1[2];
	const float e2x = tri->e2[0], e2y = tri->e2[1], e2z = tri->e2[2];
	const packf px = fma(p->dy, e2z, -(p->dz * e2y));
	const packf py = fma(p->dz, e2x, -(p->dx * e2z));
	const packf pz = fma(p->dx, e2y, -(p->dy * e2x));
	const packf inverse = 1.0f / fma(e1z, pz, fma(e1y, py, e1x * px));
	const packf sx = p->ox - tri->v0[0], sy = p->oy - tri->v0[1], sz = p->oz - tri->v0[2];
	const packf u = fma(sz, pz, fma(sy, py, sx * px)) * inverse;
	const packf qx = fma(sy, e1z, -(sz * e1y));
	const packf qy = fma(sz, e1x, -(sx * e1z));
	const packf qz = fma(sx, e1y, -(sy * e1x));
	const packf v = fma(p->dz, qz, fma(p->dy, qy, p->dx * qx)) * inverse;

	*t = fma(e2z, qz, fma(e2y, qy, e2x * qx)) * inverse;
	*b1 = u;
	*b2 = v;
	return (u >= -RAYS_EDGE_SLACK) & (v >= -RAYS_EDGE_SLACK) & (u + v <= 1 + RAYS_EDGE_SLACK) &
	       (*t >= p->t_min) & (*t <= p->t_max);
}

#endif
