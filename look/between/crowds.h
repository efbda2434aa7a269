/*
 * Many draws of the same points, as of one wheel or crate at many places. A program may leave out one of them, and the
 * n-th is another one then. So these are coupled in an order that begins with what is sure:
 *   1. draws with a shape in eye space that no other has, in either frame: motions keep shapes;
 *   2. those that a motion takes to their place, which draws of stage 1 and single ones have;
 *   3. the rest: n-th to n-th, if both frames have as many and nothing above speaks against it; else to the nearest
 *      that is left and no farther than the draw's size, of the same shape if there is one.
 */
#pragma once

#include "look/between/groups.h"

/** Find crowds, and couple those of stage 1. Draws without a crowd are sure. @return 0 or ERR_SYSTEM (reported) */
int crowds_find(struct bridge *b, struct groups *crowds);

/** Couple the others. b->motions and the camera are known. */
void crowds_couple(struct bridge *b, const struct groups *crowds);
