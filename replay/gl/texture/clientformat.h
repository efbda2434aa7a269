/* Formats and types of pixels in client memory (GL 2.1 tables 3.5, 3.6 and 3.8). */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* The components of a pixel: 0 .. 3 R G B A, 4 luminance (all of RGB), 5 depth. */
struct gls_client_format {
	uint32_t token;
	unsigned n;
	uint8_t to[4];
};

/* Packed types: the number of bits of each component, the first in the highest bits unless reversed. */
struct gls_packed {
	uint32_t token;
	unsigned bytes, n, bits[4], reversed;
};

/** @return NULL: indices, or not a known format */
const struct gls_client_format *gls_client_format_find(uint32_t token);
/** @return NULL: each component has bytes of its own, or not a known type */
const struct gls_packed *gls_packed_find(uint32_t token);
/** Bytes of a component, or of packed depth and stencil; 0: not a valid type. */
size_t gls_component_bytes(uint32_t type);
