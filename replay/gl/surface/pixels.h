#ifndef REPLAY_GL_SURFACE_PIXELS_H
#define REPLAY_GL_SURFACE_PIXELS_H

#include <stddef.h>
#include <stdint.h>

struct gls_exec;
struct gls_state;

/** Draw a rectangle of pixels with the raster position's attributes; left, low: its first pixel's outer corner. */
void gls_draw_rectangle(struct gls_exec *x, struct gls_state *st, uint32_t kind, float left, float low, uint32_t width,
                        uint32_t height, const float zoom[2], const uint8_t *texels);
/** The same, but that nothing touches the fragments but scissor, colour mask and masks of the kind of pixels. */
void gls_draw_rectangle_plainly(struct gls_exec *x, struct gls_state *st, uint32_t kind, float left, float low, uint32_t width,
                                uint32_t height, const float zoom[2], const uint8_t *texels);

/**
 * Pixels of COLOR_INDEX or STENCIL_INDEX (sec. 3.6.5): shifted, offset, through the maps.
 * @param texels  receives colours, or stencil values of 4 bytes
 * @return 0, or -1: no type of indices
 */
int gls_unpack_indices(const struct gls_state *st, uint32_t format, uint32_t type, const uint8_t *data, size_t n, uint32_t width,
                       uint32_t height, uint8_t *texels);

#endif
