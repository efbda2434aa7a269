/* Sixteen-lane numbers and vectors. OpenCL C only. */
#pragma once

#include "kernels/common.h"
#include "kernels/rays/lanes.h"

#define LANE(vector, type, lane) (((type *)&(vector))[lane])

/* rint and floor; PoCL's own take twenty instructions. From 2^23 on, floats have no fraction. */
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

/* Component i, 0 to 3, of a vector. */
#define CHANNEL(vector, i) ((&(vector).x)[i])

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

WIDE_VECTORS static inline struct vec4_16 v4_same(struct vec4 v)
{
	return v4_16((packf)(v.x), (packf)(v.y), (packf)(v.z), (packf)(v.w));
}

WIDE_VECTORS static inline struct vec4_16 v4_choose(packi mask, struct vec4_16 yes, struct vec4_16 no)
{
	return v4_16(select(no.x, yes.x, mask), select(no.y, yes.y, mask), select(no.z, yes.z, mask),
	             select(no.w, yes.w, mask));
}

/* A single lane of sixteen. */
static inline struct vec4 v4_lane(const struct vec4_16 *v, uint lane)
{
	return v4(LANE(v->x, const float, lane), LANE(v->y, const float, lane), LANE(v->z, const float, lane),
	          LANE(v->w, const float, lane));
}

static inline void v4_put_lane(struct vec4 from, uint lane, struct vec4_16 *v)
{
	LANE(v->x, float, lane) = from.x;
	LANE(v->y, float, lane) = from.y;
	LANE(v->z, float, lane) = from.z;
	LANE(v->w, float, lane) = from.w;
}

#include "kernels/sixteen_lanes.h"
#include "kernels/vector_lanes.h"
#include "kernels/one_lanes.h"
