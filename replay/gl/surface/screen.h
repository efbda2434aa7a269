/* The surfaces that a context draws to and reads from. */
#pragma once

#include "replay/build/frame.h"

struct gls_drawable;

/** The window of this name; its surfaces get its size and the context's bits. NULL: out of memory */
struct gls_drawable *gls_window_of(struct gls_exec *x, const struct gls_state *st, uint64_t name);

/** Find all surfaces that an event of the context changes. @return their number; 0: none, or out of memory */
unsigned gls_targets_of(struct gls_exec *x, struct gls_state *st, struct gls_target out[2]);

/**
 * The pixels that the context reads (ReadBuffer, read framebuffer, read drawable), after all earlier draws.
 * @param area, @return  as in gls_surface_read
 */
const struct scene_picture *gls_read_screen(struct gls_exec *x, struct gls_state *st, const struct gls_area *area);

/** The pixel type for colours to be drawn, so that none is clamped unnecessarily: SCENE_*_PIXELS. */
uint32_t gls_color_pixels(struct gls_exec *x, struct gls_state *st);
