/*
 * Formulas are written once for one place and for sixteen: in files NAME_lanes.h, which are included after this header,
 * and in kernels again after sixteen_lanes.h. They say with these words what differs:
 *
 * LANES          begins a function; both widths have the same names
 * REAL WORD INT  a float, a uint32_t and an int of each lane
 * MASK           what comparisons of them give; && || ! and ?: take it
 * VEC3 VEC4      vectors of REALs; V3 and V4 make one
 * LANED(name)    a struct's name, which has a width of its own
 * SAME(x)        a float that all lanes share, where a REAL is needed; others are converted by (WORD)(x) and the like
 * SAME3 SAME4    the same of a vector
 * IF_ALL(x)      a MASK of what is true in all lanes or in none; ANY(mask): whether it is true in any
 * CHOOSE(mask, yes, no), CHOOSE3, CHOOSE4  of REALs and vectors. Sixteen lanes work out both: no branch is spared
 * MOST(x, y), LEAST  the larger and the smaller one; of a NaN, either
 * ROUND          to the nearest whole number, the even one of two
 * TO_REAL TO_WORD TO_INT  the same value; BITS OF_BITS AS_INT AS_WORD: the same bits
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
#define LANED(name) name
#define SAME(x) (x)
#define SAME3(v) (v)
#define SAME4(v) (v)
#define IF_ALL(x) (x)
#define ANY(mask) (mask)
#define CHOOSE(mask, yes, no) ((mask) ? (yes) : (no))
#define CHOOSE3(mask, yes, no) ((mask) ? (yes) : (no))
#define CHOOSE4(mask, yes, no) ((mask) ? (yes) : (no))
#define MOST(x, y) M_MAX(x, y)
#define LEAST(x, y) M_MIN(x, y)
#define ROUND(x) M_RINT(x)
#define TO_REAL(x) ((float)(x))
#define TO_WORD(x) ((uint32_t)(x))
#define TO_INT(x) ((int)(x))
#define BITS(x) M_BITS(x)
#define OF_BITS(x) M_FLOAT(x)
#define AS_INT(x) ((int)(x))
#define AS_WORD(x) ((uint32_t)(x))
