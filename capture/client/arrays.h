/*
 * Runs inside the traced program. Vertex arrays in client memory: their content is known only at the draw.
 *
 * Before each draw every enabled array without a buffer object is written as a made-up gl*Pointer call. Its pointer is
 * a blob of the elements 0 .. highest used, or an offset in a buffer that holds the same bytes (mirror.h). The driver
 * is the authority on array state (array_state.h).
 */
#pragma once

#include <stdint.h>

/** The trace's pointers may differ from those that the recorder wrote last; array state may have changed. */
void arrays_forget(void);
/** The program has set a pointer. */
void arrays_pointer_set(void);
/** The program has called glInterleavedArrays; it is not written unless its pointer is an offset. */
void arrays_interleaved(void);

/* Before draws. */
void arrays_draw(int first, int count, int instances, unsigned base_instance);
void arrays_draw_elements(int count, unsigned type, const void *indices, int base_vertex, int instances,
                          unsigned base_instance);
void arrays_multi_draw(const int *first, const int *count, int draws);
void arrays_multi_draw_elements(const int *count, unsigned type, const void *const *indices, int draws,
                                const int *base_vertex);
void arrays_draw_indirect(const void *indirect, int draws, int stride);
void arrays_draw_elements_indirect(unsigned type, const void *indirect, int draws, int stride);

/** The parameters of indirect draws: their size in bytes, and their address or offset. */
long indirect_bytes(int elements, int draws, int stride);
uint8_t *put_indirect(uint8_t *p, const void *indirect, long bytes);
