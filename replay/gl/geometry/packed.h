/* Vertex attributes packed into one number: 10, 10, 10 and 2 bits (ARB_vertex_type_2_10_10_10_rev). */
#pragma once

#include <stdint.h>

/** 1 if a type of vertex arrays is packed. */
int gls_is_packed(uint32_t type);

/**
 * Unpack four components; `normalized`: map them to [0,1] or [-1,1], as in GL 4.2 (sec. 2.3.5.1), which Mesa follows.
 */
void gls_unpack_packed(uint32_t value, uint32_t type, uint32_t normalized, float out[4]);
