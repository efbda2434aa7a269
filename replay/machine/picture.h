/* Pictures: rendered pixels, shared by reference. */
#pragma once

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

struct gls_exec;

/* Freed with the last reference, in any thread. */
struct gls_picture {
	struct scene_picture picture; /* must be first */
	atomic_uint refs;
	uint32_t lacks; /* buffers whose contents come from skipped frames and are unknown; bits as in scene_clear */
};

/* The planes of a picture. */
struct gls_picture_form {
	uint32_t width, height, depth_bits, alpha_bits;
	uint32_t samples; /* per pixel; if more than one, each has a picture of its own beside their mean */
	uint32_t floats;  /* 1: colours are also stored as floats */
};

/**
 * Create a black picture, with depth at the far plane and stencil 0. @return a reference; NULL: out of memory
 * (reported)
 */
struct gls_picture *gls_picture_make(struct gls_exec *x, const struct gls_picture_form *form);
/** Add a reference; NULL stays NULL. */
struct gls_picture *gls_picture_reference(struct gls_picture *p);
void gls_picture_release(struct gls_picture *p);
/** The colour at a place in a picture. */
void gls_picture_color(const struct scene_picture *p, size_t place, float out[4]);
