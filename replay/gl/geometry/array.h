/* Vertex arrays (GL 2.1 sec. 2.8): where they are and what they hold. */
#ifndef REPLAY_GL_GEOMETRY_ARRAY_H
#define REPLAY_GL_GEOMETRY_ARRAY_H

#include <stddef.h>
#include <stdint.h>

struct gls_array;
struct gls_exec;
struct gls_state;
struct trace_value;

/** Contents of an array in client memory; the bytes are copied. */
void gls_array_set_client(struct gls_exec *x, struct gls_array *array, const uint8_t *data, size_t n);

#endif
