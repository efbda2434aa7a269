/*
 * Formulas are written once for one place and for sixteen: in files NAME_lanes.h, which are included after this header,
 * and in kernels again after sixteen_lanes.h. They say with these words what differs:
 *
 * LANES          begins a function; both widths have the same names
 * REAL WORD INT  a float, a uint32_t and an int of each lane
 * MASK           what comparisons of them give; && || ! and ?: take it
 * VEC3 VEC4      vectors of REALs; V3 and V4 make one
 * SAME(x)        a float that all lanes share, where a REAL is needed; others are converted by (WORD)(x) and the like
 * CHOOSE(mask, yes, no), CHOOSE3  of REALs and vectors. Sixteen lanes work out both: no branch is spared
 * MOST(x, y)     the larger one; of a NaN, either
 * TO_REAL        the value of a WORD or an INT; BITS, OF_BITS, AS_INT: the same bits
 *
 * Sums are built up in variables, not in a struct that is returned: compilers leave that one in memory.
 */
#include "kernels/no_lanes.h"

#define LANES static inline
#define REAL float
#define WORD uint32_t
#define INT int
#define MASK int
#define VEC3 struct vec3
#define VEC4 struct vec4
#define V3(x, y, z) v3(x, y, z)
#define V4(x, y, z, w) v4(x, y, z, w)
#define SAME(x) (x)
#define CHOOSE(mask, yes, no) ((mask) ? (yes) : (no))
#define CHOOSE3(mask, yes, no) ((mask) ? (yes) : (no))
#define MOST(x, y) M_MAX(x, y)
#define TO_REAL(x) ((float)(x))
#define BITS(x) M_BITS(x)
#define OF_BITS(x) M_FLOAT(x)
#define AS_INT(x) ((int)(x))
