/* Numbers and vectors of sixteen places, a lane each. OpenCL C only. */
#pragma once

#include "kernels/common.h"
#include "kernels/rays/lanes.h"

/* What rint and floor do; PoCL's own take twenty instructions. From 2^23 on numbers have no fraction. */
WIDE_VECTORS static inline packf pack_round(packf x)
{
	const packf size = fabs(x), rounded = (size + 0x1p23f) - 0x1p23f;

	return select(x, select(rounded, -rounded, x < 0.0f), size < 0x1p23f);
}

WIDE_VECTORS static inline packf pack_floor(packf x)
{
	const packf rounded = pack_round(x);

	return select(rounded, rounded - 1.0f, rounded > x);
}

struct vec3_16 {
	packf x, y, z;
};

struct vec4_16 {
	packf x, y, z, w;
};

WIDE_VECTORS static inline struct vec3_16 v3_16(packf x, packf y, packf z)
{
	struct vec3_16 v;

	v.x = x;
	v.y = y;
	v.z = z;
	return v;
}

WIDE_VECTORS static inline struct vec4_16 v4_16(packf x, packf y, packf z, packf w)
{
	struct vec4_16 v;

	v.x = x;
	v.y = y;
	v.z = z;
	v.w = w;
	return v;
}

WIDE_VECTORS static inline struct vec3_16 v3_same(struct vec3 v)
{
	return v3_16((packf)(v.x), (packf)(v.y), (packf)(v.z));
}

WIDE_VECTORS static inline struct vec3_16 v3_choose(packi mask, struct vec3_16 yes, struct vec3_16 no)
{
	return v3_16(select(no.x, yes.x, mask), select(no.y, yes.y, mask), select(no.z, yes.z, mask));
}

#include "kernels/sixteen_lanes.h"
#include "kernels/vector_lanes.h"
#include "kernels/one_lanes.h"
