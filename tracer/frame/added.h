/* How many pixels of a frame show what tracing adds to OpenGL's picture: counted while their planes are in a CPU's
 * caches. */
#pragma once

#include "tracer/frame/frame.h"

/** 1 where a picture's pixels are counted: tracer_options.counts, in the modes that add light. */
int added_counts(const struct job *job);

/** 1 where that needs a channel group, whether the picture has it or not. */
int added_needs(const struct job *job, const char *group);

/**
 * Count a band's pixels in job.added; its first band begins anew.
 * @param halves  planes as the request says
 */
void added_take(struct job *job, const struct compose_request *request, const uint16_t *halves);
