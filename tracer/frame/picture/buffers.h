/* Buffers of this room. */
#pragma once

#include "tracer/frame/common/frame.h"

/* X(element, name): those of a band. */
#define PICTURE_BUFFERS(X) X(uint, colors) X(uint, depths) X(half, halves) X(float, floats)
struct picture_buffers {
	union buffer_float sums; /* all passes so far, for all pixels of the frame */
	PICTURE_BUFFERS(FRAME_FIELD)
};
