/*
 * Eight planes around a bundle of rays, against boxes. OpenCL C only.
 *
 * A box is outside as soon as one plane has it all on its outer side (Assarsson and Moller 2000, "Optimized view frustum
 * culling algorithms for bounding boxes"): its corner that lies farthest along the plane's normal decides. With the
 * planes in lanes that is six multiply-adds a box, however many rays there are.
 */
#ifndef KERNELS_FRUSTUM_H
#define KERNELS_FRUSTUM_H

#include "replay/scene.h"
#include "kernels/shared.h"
#include "kernels/lanes.h"

/* Inside is where a x + b y + c z + d >= 0, for every lane. p: positive part of a coefficient, n: negative part. */
struct frustum {
	float8 ap, an, bp, bn, cp, cn, d;
};

/* Per lane how far the box of one side of a node reaches inside; negative: the box is outside. */
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

/* 0 for the empty side of a root. */
static inline int side_exists(__global const struct node2 *node, uint side)
{
	return (node->child[side] | node->count[side]) != 0;
}

/*
 * Planes with coefficients a b c d. abs_a .. abs_d bound the terms that each was added up from; what rounding may have
 * done to them, at any point of the tree under `root`, is given back.
 */
static inline struct frustum frustum_make(float8 a, float8 b, float8 c, float8 d, float8 abs_a, float8 abs_b, float8 abs_c,
                                   float8 abs_d, __global const struct node2 *root)
{
	struct frustum f;
	float reach[3];

	for (int axis = 0; axis < 3; axis++) {
		reach[axis] = fmax(fabs(root->lo[0][axis]), fabs(root->hi[0][axis]));
		if (side_exists(root, 1))
			reach[axis] = fmax(reach[axis], fmax(fabs(root->lo[1][axis]), fabs(root->hi[1][axis])));
	}
	f.ap = fmax(a, 0.0f), f.an = fmin(a, 0.0f);
	f.bp = fmax(b, 0.0f), f.bn = fmin(b, 0.0f);
	f.cp = fmax(c, 0.0f), f.cn = fmin(c, 0.0f);
	f.d = d + 1e-6f * (abs_a * reach[0] + abs_b * reach[1] + abs_c * reach[2] + abs_d);
	return f;
}

#endif
