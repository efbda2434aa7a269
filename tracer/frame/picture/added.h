/* Counts the pixels of a frame that show something that tracing adds to OpenGL's picture. They are counted while their
 * planes are in a CPU's caches. */
#pragma once

#include "tracer/frame/common/frame.h"

/** 1 if a picture's pixels are counted: with tracer_options.counts, in the modes that add light. */
int added_counts(const struct pass *pass);

/** 1 if counting needs a channel group, whether or not the picture has it. */
int added_needs(const struct pass *pass, const char *group);

/**
 * Count a band's pixels in drawn.added. The first band of a picture resets the counts.
 * @param halves  planes of the band, as laid out by the request
 */
void added_take(const struct band *band, const struct compose_request *request, const uint16_t *halves);
