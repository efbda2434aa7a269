/* Vertex arrays (GL 2.1 sec. 2.8): their contents, and drawing from them. */
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
/** glDrawArrays: draw, or keep in the list that is being made; errors as GL has them. */
void gls_draw_arrays(struct gls_exec *x, struct gls_state *st, uint32_t mode, int64_t first, int64_t count);
/**
 * glDrawElementsBaseVertex.
 * @param indices  a blob of them, or their offset in the element buffer
 */
void gls_draw_elements(struct gls_exec *x, struct gls_state *st, uint32_t mode, int64_t count, uint32_t type,
                       const struct trace_value *indices, int32_t base);

#endif
