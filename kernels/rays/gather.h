/* Loads table entries for sixteen lanes at once, transposed into rows, and back. OpenCL C only. */
#pragma once

#include "kernels/rays/lanes.h"

/*
 * Transpose quarters of two rows, four numbers each, with one instruction per result. If written number by number, LLVM
 * 15 turns them and the preceding loads into long chains of dependent steps.
 */
#if LANES_OWN(__builtin_shufflevector)
#define GATHER_TURN(a, b, i, j, k, l) \
	__builtin_shufflevector(a, b, i, j, k, l, i + 4, j + 4, k + 4, l + 4, i + 8, j + 8, k + 8, l + 8, i + 12, j + 12, \
	k + 12, l + 12)
#define GATHER_LOW(a, b) GATHER_TURN(a, b, 0, 16, 1, 17)
#define GATHER_HIGH(a, b) GATHER_TURN(a, b, 2, 18, 3, 19)
#define GATHER_FIRST_PAIRS(a, b) GATHER_TURN(a, b, 0, 1, 16, 17)
#define GATHER_SECOND_PAIRS(a, b) GATHER_TURN(a, b, 2, 3, 18, 19)
#else
#define GATHER_LOW(a, b) \
	(packf)(a.s0, b.s0, a.s1, b.s1, a.s4, b.s4, a.s5, b.s5, a.s8, b.s8, a.s9, b.s9, a.sc, b.sc, a.sd, b.sd)
#define GATHER_HIGH(a, b) \
	(packf)(a.s2, b.s2, a.s3, b.s3, a.s6, b.s6, a.s7, b.s7, a.sa, b.sa, a.sb, b.sb, a.se, b.se, a.sf, b.sf)
#define GATHER_FIRST_PAIRS(a, b) \
	(packf)(a.s0, a.s1, b.s0, b.s1, a.s4, a.s5, b.s4, b.s5, a.s8, a.s9, b.s8, b.s9, a.sc, a.sd, b.sc, b.sd)
#define GATHER_SECOND_PAIRS(a, b) \
	(packf)(a.s2, a.s3, b.s2, b.s3, a.s6, a.s7, b.s6, b.s7, a.sa, a.sb, b.sa, b.sb, a.se, a.sf, b.se, b.sf)
#endif

/* Four numbers with the alignment of one. PoCL's vload4 loads them two at a time. */
typedef float4 gather_loose __attribute__((aligned(4)));

INLINED float4 gather_four(__global const float *at)
{
	return *(__global const gather_loose *)at;
}

/*
 * Transpose four numbers of sixteen lanes between rows and lanes. As a lane's data, quarter q of the kth vector belongs
 * to lane 4 q + k. Applying it twice restores the original.
 */
WIDE_VECTORS INLINED void pack_turn_rows(packf a, packf b, packf c, packf d, packf *turned)
{
	const packf ab = GATHER_LOW(a, b), cd = GATHER_LOW(c, d), ab_high = GATHER_HIGH(a, b), cd_high = GATHER_HIGH(c, d);

	turned[0] = GATHER_FIRST_PAIRS(ab, cd);
	turned[1] = GATHER_SECOND_PAIRS(ab, cd);
	turned[2] = GATHER_FIRST_PAIRS(ab_high, cd_high);
	turned[3] = GATHER_SECOND_PAIRS(ab_high, cd_high);
}

/* Load four numbers from each of sixteen addresses, transposed into rows. */
WIDE_VECTORS INLINED void pack_gather_from(__global const float *table, packu place, packf *row)
{
	const packf a = (packf)(gather_four(table + place.s0), gather_four(table + place.s4),
	                        gather_four(table + place.s8), gather_four(table + place.sc));
	const packf b = (packf)(gather_four(table + place.s1), gather_four(table + place.s5),
	                        gather_four(table + place.s9), gather_four(table + place.sd));
	const packf c = (packf)(gather_four(table + place.s2), gather_four(table + place.s6),
	                        gather_four(table + place.sa), gather_four(table + place.se));
	const packf d = (packf)(gather_four(table + place.s3), gather_four(table + place.s7),
	                        gather_four(table + place.sb), gather_four(table + place.sf));

	pack_turn_rows(a, b, c, d, row);
}

/* Load sixteen of a table's entries of four numbers. */
WIDE_VECTORS INLINED void pack_gather(__global const float *table, packu index, packf *row)
{
	pack_gather_from(table, index * 4, row);
}
