/* Defines the words of one_lanes.h for sixteen lanes. OpenCL C only, after frame/pack/pack_vector.h. */
#include "kernels/no_lanes.h"

#define LANES WIDE_VECTORS static inline __attribute__((overloadable))
#define REAL packf
#define WORD packu
#define INT packi
#define MASK packi
#define VEC3 struct vec3_16
#define VEC4 struct vec4_16
#define V3(x, y, z) v3_16(x, y, z)
#define V4(x, y, z, w) v4_16(x, y, z, w)
#define LANED(name) name##_16
#define SAME(x) ((packf)(x))
#define SAME3(v) v3_same(v)
#define SAME4(v) v4_same(v)
#define IF_ALL(x) ((x) ? (packi)(-1) : (packi)(0))
#define ANY(mask) any_pack(mask)
#define CHOOSE(mask, yes, no) ((mask) ? (yes) : (no))
#define CHOOSE3(mask, yes, no) v3_choose(mask, yes, no)
#define CHOOSE4(mask, yes, no) v4_choose(mask, yes, no)
#define MOST(x, y) pack_max(x, y)
#define LEAST(x, y) pack_min(x, y)
#define ROUND(x) pack_round(x)
#define TO_REAL(x) convert_float16(x)
#define TO_WORD(x) convert_uint16(x)
#define TO_INT(x) convert_int16(x)
#define BITS(x) as_uint16(x)
#define OF_BITS(x) as_float16(x)
#define AS_INT(x) as_int16(x)
#define AS_WORD(x) as_uint16(x)
