/*
 * Formulas are written once for both one lane and sixteen, in files NAME_lanes.h. These are included after this header
 * and, in kernels, again after sixteen_lanes.h. The following words stand for what differs:
 *
 * LANES          begins a function; functions have the same name in both widths
 * REAL WORD INT  a float, a uint32_t and an int of each lane
 * MASK           result of comparing them; usable with && || ! and ?:
 * VEC3 VEC4      vectors of REALs; V3 and V4 make one
 * LANED(name)    a struct's name, which differs between widths
 * SAME(x)        a float that all lanes share, as a REAL; other types are converted by (WORD)(x) and so on
 * SAME3 SAME4    the same for a vector
 * IF_ALL(x)      a MASK from a condition that all lanes share; ANY(mask): whether it is true in any lane
 * CHOOSE(mask, yes, no), CHOOSE3, CHOOSE4  for REALs and vectors. Sixteen lanes evaluate both sides, so this saves no
 *                                          branch
 * MOST(x, y), LEAST  maximum and minimum; with a NaN, either argument
 * ROUND          round to nearest, ties to even
 * TO_REAL TO_WORD TO_INT  the same value; BITS OF_BITS AS_INT AS_WORD: the same bits
 *
 * Sums are accumulated in local variables, not in a returned struct, which compilers keep in memory.
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
