/* Drawing from vertex arrays (GL 2.1 sec. 2.8). */
#pragma once

#include <stdint.h>

struct gls_exec;
struct gls_state;
struct trace_value;

/** glDrawArrays: draw, or add to the list being compiled. Raises GL errors. */
void gls_draw_arrays(struct gls_exec *x, struct gls_state *st, uint32_t mode, int64_t first, int64_t count);
/**
 * glDrawElementsBaseVertex.
 * @param indices  a blob of indices, or their offset in the element buffer
 */
void gls_draw_elements(struct gls_exec *x, struct gls_state *st, uint32_t mode, int64_t count, uint32_t type,
                       const struct trace_value *indices, int32_t base);
