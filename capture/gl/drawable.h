/* Runs inside the traced program. Drawables: windows, pbuffers and surfaces, and their sizes. */
#ifndef CAPTURE_GL_DRAWABLE_H
#define CAPTURE_GL_DRAWABLE_H

#include <stdint.h>

struct drawable {
	struct drawable *next;
	uintptr_t id;
	unsigned long window; /* X window or pixmap to ask the size of; 0: the size cannot change */
	int width, height;    /* when it was asked; 0: not yet */
	uint64_t asked_ns;
};

/** Drawable number `id`, made at need; it stays. NULL: no memory. */
struct drawable *drawable_find(uintptr_t id);

void drawable_is_window(unsigned long glx_window, unsigned long window);
void drawable_is_pbuffer(void *display, unsigned long pbuffer);
void drawable_may_have_changed(void);

/**
 * Ask for the size, a trip to the X server: not at each frame, but when the program has set a viewport, or after a while.
 * @param exact  1: ask now
 */
void drawable_ask_glx(struct drawable *d, void *display, int exact);
void drawable_ask_egl(struct drawable *d, void *display, int exact);

/** Calls that draw nothing, by which glretrace's window learns of the size that a viewport has given it. */
void drawable_make_size_known(void);

#endif
