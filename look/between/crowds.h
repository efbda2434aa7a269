/*
 * Crowds: many draws of the same points, such as a wheel or a crate at many places. If a program omits one of them, the
 * n-th draw is another one than before. So they are coupled in order of certainty:
 *   1. draws whose shape in eye space is unique in both frames; motions do not change shapes
 *   2. draws that a motion of stage 1 or of single draws takes to their place
 *   3. the rest: the n-th with the n-th, if both frames have the same number and nothing above contradicts it;
 *      otherwise with the nearest that is left, no farther away than the draw's size, of the same shape if possible
 */
#pragma once

#include "look/between/groups.h"

/** Find crowds, and couple those of stage 1. Draws outside crowds are sure. @return 0 or ERR_SYSTEM (reported) */
int crowds_find(struct bridge *b, struct groups *crowds);

/** Couple the others. b->motions and the camera must be known. */
void crowds_couple(struct bridge *b, const struct groups *crowds);
