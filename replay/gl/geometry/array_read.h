/* Reading vertex arrays: their bytes as they are at a draw, and elements as floats (GL 2.1 sec. 2.8, table 2.4). */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "replay/machine/state.h"

struct gls_exec;

/* An array's bytes as they are now. */
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
	int has_edges, has_sizes; /* sizes: of points (OES_point_size_array); no mesh depends on them */
};

/** Bytes of a component; 0: no type. */
size_t gls_type_bytes(uint32_t type);
/** Element i as four floats, normalized if the array is. Missing components are 0, 0, 0, 1. Beyond the array's end all
 * that it would have are 0, as Mesa (22.3.6) reads buffer objects. */
void gls_source_read(const struct gls_source *s, uint64_t i, float out[4]);

/** Those of vertex programs only where one draws, or a list is made. @return the attributes that come from arrays, as
 * in gls_geometry.varying */
uint32_t gls_sources_open_attributes(struct gls_exec *x, struct gls_state *st, struct gls_sources *s);
/** Positions and edge flags too. @return 1; 0: there is nothing to draw from (counted) */
int gls_sources_open(struct gls_exec *x, struct gls_state *st, struct gls_sources *s);
/** How many vertices they hold: as many as the positions or, where these are one constant, the longest array of the
 * others. */
uint64_t gls_sources_count(const struct gls_sources *s);
/** The first element that no array has: it and all that follow are the same vertex. */
uint64_t gls_sources_end(const struct gls_sources *s);
/** A hash of all that a draw's mesh depends on. elements: a hash of the indices, or the first vertex. */
uint64_t gls_sources_key(const struct gls_state *st, const struct gls_sources *s, uint32_t mode, uint64_t elements,
                         uint64_t n_elements);
