/* Runs inside the traced program. Frame ends: markers are written and the limits of `relume record` are applied. */
#pragma once

#include "capture/gl/drawable.h"
#include "capture/stats.h"

/** Set the target that this thread draws to from now on. */
void frame_draw_to(const struct drawable_target *target);

/** Before a swap is written, and after it. */
void frame_end_glx(void *display, unsigned long drawable);
void frame_end_egl(void *display, void *surface);
void frame_ended(void);

/**
 * The program has set a viewport. If it exceeds the known size of the window, the window may have grown, and what is
 * drawn from here on is visible. Each size is queried only once: some programs' viewports always exceed their window.
 */
void frame_viewport(int x, int y, int width, int height);

/** A list called in between may hold the End. If not, the program's own call there is the same error as ours. */
void frame_primitive_begins(void);
void frame_primitive_ended(void);
void frame_drawn(void);
void frame_cleared(unsigned buffers);
/**
 * A part of the back buffer becomes visible. That shows a picture as a swap does, which ends a frame; further parts of
 * the same picture do not.
 */
void frame_copied(void);
/** Ends a frame if `record --frame-end` selects the call, `truth` holds, and something was drawn since the last one. */
void frame_may_end(enum frame_trigger trigger, int truth);
