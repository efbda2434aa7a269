/*
 * References, which the surface area heuristic builders divide: boxes with their item. Used by sah_build.inc and its
 * helpers.
 */
#pragma once

#include "tracer/accel/box8.h"

/* The item is in lane 3 of the lower half. This bit makes it a normal float there: denormals slow arithmetic down. */
#define SAH_ITEM_IS_FLOAT 0x40000000u
#define SAH_MOST_ITEMS 0x3f000000u

static inline uint32_t sah_item_of(box8 ref)
{
	return (uint32_t)((ivec4)box8_negative_lo(ref))[3] & ~SAH_ITEM_IS_FLOAT;
}

/* A subtree that is still to be built: `count` references at `first`, with room for `room` references. */
struct sah_part {
	uint32_t first, count, room, depth;
	box8 box, centres; /* bounds of twice the centres: only comparisons matter */
};
