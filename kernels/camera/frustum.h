/*
 * Tests boxes against eight planes around a bundle of rays. OpenCL C only.
 *
 * A box is outside if it lies entirely on the outer side of one plane (Assarsson and Moller 2000, "Optimized view
 * frustum culling algorithms for bounding boxes"); the corner farthest along the plane's normal decides. With the
 * planes in lanes, that takes six multiply-adds per box, however many rays there are.
 */
#pragma once

#include "kernels/common.h"
#include "kernels/rays/lanes.h"

/* Inside means a x + b y + c z + d >= 0 in every lane. p: positive part of a coefficient, n: negative part. */
struct frustum {
	float8 ap, an, bp, bn, cp, cn, d;
};

/* Per lane, how far the box of one side of a node reaches inside; negative: the box is outside. */
static inline float8 frustum_reach(const struct frustum *f, __global const struct node2 *node, uint side)
{
	const float8 x = fma(f->ap, node->hi[side][0], fma(f->an, node->lo[side][0], f->d));
	const float8 y = fma(f->bp, node->hi[side][1], f->bn * node->lo[side][1]);
	const float8 z = fma(f->cp, node->hi[side][2], f->cn * node->lo[side][2]);

	return x + (y + z);
}

static inline int frustum_meets(float8 reach)
{
	return lane_bits(as_int8(reach) < 0) == 0;
}

/* 0 for the empty side of a root node. */
static inline int side_exists(__global const struct node2 *node, uint side)
{
	return (node->child[side] | node->count[side]) != 0;
}

/* Largest distance from the origin, along each axis, that the tree under `root` reaches. */
static inline struct vec3 frustum_extent(__global const struct node2 *root)
{
	float extent[3];

	for (int i = 0; i < 3; i++) {
		extent[i] = fmax(fabs(root->lo[0][i]), fabs(root->hi[0][i]));
		if (side_exists(root, 1))
			extent[i] = fmax(extent[i], fmax(fabs(root->lo[1][i]), fabs(root->hi[1][i])));
	}
	return v3(extent[0], extent[1], extent[2]);
}

/*
 * Planes with coefficients a b c d. abs_a .. abs_d are bounds of the sums of absolute terms of each. The planes are
 * moved outwards by the rounding error possible at any point no farther from the origin than `extent`.
 */
static inline struct frustum frustum_make(float8 a, float8 b, float8 c, float8 d, float8 abs_a, float8 abs_b,
                                          float8 abs_c, float8 abs_d, struct vec3 extent)
{
	struct frustum f;

	f.ap = fmax(a, 0.0f), f.an = fmin(a, 0.0f);
	f.bp = fmax(b, 0.0f), f.bn = fmin(b, 0.0f);
	f.cp = fmax(c, 0.0f), f.cn = fmin(c, 0.0f);
	f.d = d + 1e-6f * (abs_a * extent.x + abs_b * extent.y + abs_c * extent.z + abs_d);
	return f;
}

/*
 * Five of the planes, against eight boxes at once. For each plane: the corner that lies farthest inside, as rows of a
 * node.
 */
#define FRUSTUM8_PLANES 5
struct frustum8 {
	float a[FRUSTUM8_PLANES], b[FRUSTUM8_PLANES], c[FRUSTUM8_PLANES], d[FRUSTUM8_PLANES];
	uint x[FRUSTUM8_PLANES], y[FRUSTUM8_PLANES], z[FRUSTUM8_PLANES]; /* offsets in floats from the node's start */
};

/* The first four planes and plane `far` as the last. The other planes would cull little more. */
static inline struct frustum8 frustum8_from(struct frustum f, int far)
{
	const float8 a = f.ap + f.an, b = f.bp + f.bn, c = f.cp + f.cn;
	struct frustum8 out;

	for (int i = 0; i < FRUSTUM8_PLANES; i++) {
		const int plane = i < FRUSTUM8_PLANES - 1 ? i : far;

		out.a[i] = ((const float *)&a)[plane];
		out.b[i] = ((const float *)&b)[plane];
		out.c[i] = ((const float *)&c)[plane];
		out.d[i] = ((const float *)&f.d)[plane];
		out.x[i] = out.a[i] > 0.0f ? 24 : 0;
		out.y[i] = out.b[i] > 0.0f ? 32 : 8;
		out.z[i] = out.c[i] > 0.0f ? 40 : 16;
	}
	return out;
}

/* A bit for each box that is partly inside all planes. reach: how far it reaches inside the last plane */
static inline uint frustum8_meets(const struct frustum8 *f, __global const struct node8 *node, float8 *reach)
{
	__global const float *rows = (__global const float *)node;
	int8 outside = vload8(0, node->lo[0]) > vload8(0, node->hi[0]); /* an empty slot */

	for (int i = 0; i < FRUSTUM8_PLANES; i++) {
		*reach = fma((float8)(f->a[i]), vload8(0, rows + f->x[i]), fma((float8)(f->b[i]), vload8(0, rows + f->y[i]),
		             fma((float8)(f->c[i]), vload8(0, rows + f->z[i]), (float8)(f->d[i]))));
		outside |= *reach < 0.0f;
	}
	return ~lane_bits(outside) & 255u;
}
