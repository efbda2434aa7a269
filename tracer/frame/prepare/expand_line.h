/*
 * Lines as quads, at the positions of Mesa's llvmpipe. They have the line's width, with ends by the diamond-exit rule
 * (GL 2.1 sec. 3.4); with multisampling, they are rectangles along the line; they may be smooth. A stipple (sec. 3.4.2)
 * divides them into dashes.
 */
#pragma once

#include "tracer/frame/prepare/expand_end.h"

/**
 * Project a clipped line and add the quads of its visible dashes. Advances in->dashed by its length.
 * @param a, b    ends of the line; changed
 * @param offset  added to the depth of both ends
 * @return 0 or ERR_SYSTEM (reported)
 */
int expand_edge(const struct expand_input *in, struct expanded *out, struct expand_end *a, struct expand_end *b,
                float offset, uint32_t draw);
