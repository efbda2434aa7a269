/* Reads vertex arrays: their contents at a draw, and elements as floats (GL 2.1 sec. 2.8, table 2.4). */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "replay/machine/state.h"

struct gls_exec;

/* An array's present contents. */
struct gls_source {
	const uint8_t *bytes;
	size_t n, stride, element;
	uint64_t version;
	const struct gls_array *array;
};

/* All arrays of a draw. */
struct gls_sources {
	struct gls_source vertex, edge, size, attributes[N_GLS_ATTRIBUTES];
	uint32_t present; /* attributes that come from arrays: 1 << attribute */
	int has_edges, has_sizes; /* sizes: of points (OES_point_size_array); meshes do not depend on them */
};

/** Bytes of a component; 0: not a valid type. */
size_t gls_type_bytes(uint32_t type);
/** Element i as four floats, normalized if the array is. Missing components are 0, 0, 0, 1. Beyond the array's end, all
 * components that it has are 0, as Mesa (22.3.6) reads buffer objects. */
void gls_source_read(const struct gls_source *s, uint64_t i, float out[4]);

/**
 * Open the attributes' arrays; those of vertex programs only if one runs or a list is compiled. @return the attributes
 * that come from arrays, as in gls_geometry.varying
 */
uint32_t gls_sources_open_attributes(struct gls_exec *x, struct gls_state *st, struct gls_sources *s);
/** Open all arrays, including positions and edge flags. @return 1; 0: there is nothing to draw from (counted) */
int gls_sources_open(struct gls_exec *x, struct gls_state *st, struct gls_sources *s);
/** Number of vertices in the arrays: that of the positions, or, if these are constant, of the longest other array. */
uint64_t gls_sources_count(const struct gls_sources *s);
/** The first element beyond the end of every array: all elements from there on are the same vertex. */
uint64_t gls_sources_end(const struct gls_sources *s);
/** A hash of everything that a draw's mesh depends on. elements: a hash of the indices, or the first vertex. */
uint64_t gls_sources_key(const struct gls_state *st, const struct gls_sources *s, uint32_t mode, uint64_t elements,
                         uint64_t n_elements);
