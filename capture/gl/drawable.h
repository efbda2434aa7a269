/* Runs inside the traced program. Drawables: windows, pbuffers and surfaces, and their sizes. */
#pragma once

#include <stdint.h>

struct drawable {
	struct drawable *next;
	uintptr_t id;
	unsigned long window; /* X window or pixmap to ask the size of; 0: the size cannot change */
	int width, height;    /* when it was asked; 0: not yet */
	uint64_t asked_ns;
	int marked_width, marked_height; /* as written in trace number `marked_epoch` (writer_epoch) */
	unsigned marked_epoch;
	int held_width, held_height; /* size of its buffers at the end of its last frame */
};

enum drawable_system { DRAWABLE_NONE, DRAWABLE_GLX, DRAWABLE_EGL, DRAWABLE_OSMESA };

/** The target that a thread draws to. */
struct drawable_target {
	enum drawable_system system;
	void *display;
	uintptr_t id;
	int reads_other;   /* 1: pixels are read from another drawable (GLX 1.3, EGL) */
	int width, height; /* OSMesa's, which has no drawables */
};

/** Drawable number `id`, created on demand and never freed. NULL: out of memory. */
struct drawable *drawable_find(uintptr_t id);

/** window: of X, or its pixmap */
void drawable_is_window(unsigned long glx_window, unsigned long window);
void drawable_is_pbuffer(void *display, unsigned long pbuffer);
void drawable_may_have_changed(void);

/**
 * Query the size. This takes a trip to the X server, so it is done not at each frame, but when the program has set a
 * viewport, or after a while.
 * @param exact  1: query now
 */
void drawable_ask(struct drawable *d, const struct drawable_target *target, int exact);

/** Write calls that draw nothing, but make glretrace's window take on the size of the viewport. */
void drawable_make_size_known(void);
