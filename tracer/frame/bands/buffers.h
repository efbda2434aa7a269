/* Buffers of this room. */
#pragma once

#include "tracer/frame/common/frame.h"

/* X(element, name). First those of the camera and the list of fragments, then those of plain.c, then of layered.c. */
#define BAND_BUFFERS(X) \
	X(uint, after) X(fragment, sparse) X(uint, counts) X(uint, first) X(uint, scan) \
	X(fragment, fragments) X(uint, pixels) X(shaded, shaded) X(frame_pixel, cleared) X(uint, drawn) \
	X(uint, blocks) \
	X(fragment, alone_fragments) X(uint, alone_pixels) X(shaded, alone_shaded) X(uint, leaving) X(uint, leaving_first) \
	X(float, layer_visibility) X(float, kept_pixels) X(float, next_pixels) X(layer_clear, layer_clears) X(uint, unknown)
struct band_buffers {
	BAND_BUFFERS(FRAME_FIELD)
	uint32_t *host_counts, *host_first; /* [pixels]: copies of those on the device */
	size_t n_counted;
};

/** Make room for one word per pixel of the band in host_counts and host_first. @return 0 or ERR_SYSTEM (reported) */
int band_reserve_counts(const struct band *band);

/** Make room for n fragments of the list. */
int band_reserve_list(const struct frame *frame, uint32_t n, struct fragment_list *out);
