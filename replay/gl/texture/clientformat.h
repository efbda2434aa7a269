/* Formats and types of pixels in client memory (GL 2.1 tables 3.5, 3.6 and 3.8). */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* What each component of a pixel is: 0 .. 3 R G B A, 4 luminance (all of RGB), 5 depth. */
struct gls_client_format {
	uint32_t token;
	unsigned n;
	uint8_t to[4];
};

/* Packed types: how many bits each component has. The first one has the highest bits unless they are reversed. */
struct gls_packed {
	uint32_t token;
	unsigned bytes, n, bits[4], reversed;
};

/** NULL: indices, or no format that is known. */
const struct gls_client_format *gls_client_format_find(uint32_t token);
/** NULL: each component has bytes of its own, or no type that is known. */
const struct gls_packed *gls_packed_find(uint32_t token);
/** Bytes of a component, or of packed depth and stencil; 0: no such type. */
size_t gls_component_bytes(uint32_t type);
