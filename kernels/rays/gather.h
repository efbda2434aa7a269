/* Entries of a table for sixteen lanes at once, turned into rows. OpenCL C only. */
#pragma once

#include "kernels/rays/lanes.h"

#define GATHER_LOW(a, b)                                                                                                          \
	(packf)(a.s0, b.s0, a.s1, b.s1, a.s4, b.s4, a.s5, b.s5, a.s8, b.s8, a.s9, b.s9, a.sc, b.sc, a.sd, b.sd)
#define GATHER_HIGH(a, b)                                                                                                         \
	(packf)(a.s2, b.s2, a.s3, b.s3, a.s6, b.s6, a.s7, b.s7, a.sa, b.sa, a.sb, b.sb, a.se, b.se, a.sf, b.sf)
#define GATHER_FIRST_PAIRS(a, b)                                                                                                  \
	(packf)(a.s0, a.s1, b.s0, b.s1, a.s4, a.s5, b.s4, b.s5, a.s8, a.s9, b.s8, b.s9, a.sc, a.sd, b.sc, b.sd)
#define GATHER_SECOND_PAIRS(a, b)                                                                                                 \
	(packf)(a.s2, a.s3, b.s2, b.s3, a.s6, a.s7, b.s6, b.s7, a.sa, a.sb, b.sa, b.sb, a.se, a.sf, b.se, b.sf)

/* Four numbers from each of sixteen places on, turned into rows. */
WIDE_VECTORS INLINED void pack_gather_from(__global const float *table, packu place, packf *row)
{
	const packf a = (packf)(vload4(0, table + place.s0), vload4(0, table + place.s4), vload4(0, table + place.s8), vload4(0, table + place.sc));
	const packf b = (packf)(vload4(0, table + place.s1), vload4(0, table + place.s5), vload4(0, table + place.s9), vload4(0, table + place.sd));
	const packf c = (packf)(vload4(0, table + place.s2), vload4(0, table + place.s6), vload4(0, table + place.sa), vload4(0, table + place.se));
	const packf d = (packf)(vload4(0, table + place.s3), vload4(0, table + place.s7), vload4(0, table + place.sb), vload4(0, table + place.sf));
	const packf ab = GATHER_LOW(a, b), cd = GATHER_LOW(c, d), ab_high = GATHER_HIGH(a, b), cd_high = GATHER_HIGH(c, d);

	row[0] = GATHER_FIRST_PAIRS(ab, cd);
	row[1] = GATHER_SECOND_PAIRS(ab, cd);
	row[2] = GATHER_FIRST_PAIRS(ab_high, cd_high);
	row[3] = GATHER_SECOND_PAIRS(ab_high, cd_high);
}

/* Sixteen of a table's entries of four numbers. */
WIDE_VECTORS INLINED void pack_gather(__global const float *table, packu index, packf *row)
{
	pack_gather_from(table, index * 4, row);
}
