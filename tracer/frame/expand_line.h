/*
 * Lines as quads, where Mesa's llvmpipe puts them: of the line's width, cut at their ends by the diamond-exit rule
 * (GL 2.1 sec. 3.4), under multisampling as rectangles along them, or smooth; whole or in the dashes of a stipple
 * (sec. 3.4.2).
 */
#pragma once

#include "tracer/frame/expand_end.h"

/**
 * Project a line that has been clipped, and add what its stipple leaves. in->dashed moves on by its length.
 * @param a, b    its ends; changed
 * @param offset  added to the depth of both ends
 * @return 0 or ERR_SYSTEM (reported)
 */
int expand_edge(const struct expand_input *in, struct expanded *out, struct expand_end *a, struct expand_end *b,
                float offset, uint32_t draw);
