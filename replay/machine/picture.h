/* Pictures: pixels that were rendered, shared by reference. */
#pragma once

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

struct gls_exec;

/* Freed with the last reference, in any thread. */
struct gls_picture {
	struct scene_picture picture; /* first */
	atomic_uint refs;
	uint32_t lacks; /* buffers that hold what skipped frames drew, which is not known; bits as in scene_clear */
};

/* What a picture has room for. */
struct gls_picture_form {
	uint32_t width, height, depth_bits, alpha_bits;
	uint32_t samples; /* of a pixel; more than one: each has a picture of its own, beside their mean */
	uint32_t floats;  /* 1: colours are there as floats, too */
};

/** A black picture, with depths far and stencil 0. @return a reference; NULL: out of memory (reported) */
struct gls_picture *gls_picture_make(struct gls_exec *x, const struct gls_picture_form *form);
/** One more reference; NULL stays NULL. */
struct gls_picture *gls_picture_reference(struct gls_picture *p);
void gls_picture_release(struct gls_picture *p);
/** The colour of a place in a picture. */
void gls_picture_color(const struct scene_picture *p, size_t place, float out[4]);
