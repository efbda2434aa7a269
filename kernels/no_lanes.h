/* The end of a width: before the next one begins. */
#undef LANES
#undef REAL
#undef WORD
#undef INT
#undef MASK
#undef VEC3
#undef VEC4
#undef V3
#undef V4
#undef SAME
#undef CHOOSE
#undef CHOOSE3
#undef MOST
#undef TO_REAL
#undef BITS
#undef OF_BITS
#undef AS_INT
