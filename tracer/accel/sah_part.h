/*
 * What the builders by surface area divide: references, which are boxes with their item. For sah_build.inc and its
 * helpers.
 */
#pragma once

#include "tracer/accel/box8.h"

/* The item is in lane 3 of the lower half, where it is an ordinary float: denormal ones slow arithmetic down. */
#define SAH_ITEM_IS_FLOAT 0x40000000u
#define SAH_MOST_ITEMS 0x3f000000u

static inline uint32_t sah_item_of(box8 ref)
{
	return (uint32_t)((ivec4)box8_negative_lo(ref))[3] & ~SAH_ITEM_IS_FLOAT;
}

/* What is known of a subtree before it is built: `count` references at `first`, and room for `room` of them. */
struct sah_part {
	uint32_t first, count, room, depth;
	box8 box, centres; /* twice the centres: only comparisons matter */
};
