/* Vertex array objects (GL 3.0 sec. 2.10). */
#pragma once

#include <stdint.h>

#include "replay/machine/state.h"

struct gls_exec;

/** The initial values of vertex arrays (GL 2.1 table 6.6). */
void gls_arrays_init(struct gls_array arrays[N_GLS_ARRAYS]);
/** Bind a vertex array object; create it if there is none of this name. */
void gls_vertex_array_bind(struct gls_exec *x, struct gls_state *st, uint32_t name);
void gls_vertex_array_free(struct gls_vertex_array *object);
