/* What a context draws to and reads from. */
#pragma once

#include "replay/build/frame.h"

struct gls_drawable;

/** The window of this name, its surfaces with the size it has and the bits of the context. NULL: out of memory */
struct gls_drawable *gls_window_of(struct gls_exec *x, const struct gls_state *st, uint64_t name);

/** All surfaces that an event of the context changes. @return how many; 0: none, or out of memory */
unsigned gls_targets_of(struct gls_exec *x, struct gls_state *st, struct gls_target out[2]);

/**
 * The pixels that the context reads (ReadBuffer, read framebuffer, read drawable), with all that was drawn before.
 * @param area, @return  as of gls_surface_read
 */
const struct scene_picture *gls_read_screen(struct gls_exec *x, struct gls_state *st, const struct gls_area *area);

/** The kind of pixels that colours for what is drawn to should come as, so that none is clamped needlessly:
 * SCENE_*_PIXELS. */
uint32_t gls_color_pixels(struct gls_exec *x, struct gls_state *st);
