/* Runs inside the traced program. The ends of frames: what is marked there, and what `relume record` wants of them. */
#pragma once

#include "capture/gl/drawable.h"
#include "capture/stats.h"

/** What this thread draws to from now on. */
void frame_draw_to(const struct drawable_target *target);

/** Before a swap is written, and after it. */
void frame_end_glx(void *display, unsigned long drawable);
void frame_end_egl(void *display, void *surface);
void frame_ended(void);

/**
 * The program has set a viewport. One that reaches beyond the window as it was: has the window grown? What is drawn from here on is then
 * seen. It is asked once for a size: some programs' viewports are always larger than their window.
 */
void frame_viewport(int x, int y, int width, int height);

/** A list that is called in between may hold the End. Where it does not, the program's own call there is the same error as ours. */
void frame_primitive_begins(void);
void frame_primitive_ended(void);
void frame_drawn(void);
void frame_cleared(unsigned buffers);
/** A call that ends a frame where `record --frame-end` says so, `truth` holds, and something was drawn since the last one. */
void frame_may_end(enum frame_trigger trigger, int truth);
