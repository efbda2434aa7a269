/*
 * Draws that deform, such as fish or cloth: their points appear nowhere in the other frame, but their triangles and
 * texture coordinates do. The cost of a couple is 0 if nothing changes. It grows with the stretch of its edges,
 * relative to their lengths, and with its displacement, relative to the sum of displacement and size; each of the two
 * is less than 1. A draw without a partner costs half, or 1 if both frames have as many of its kind. For each kind,
 * the cheapest alignment of both frames' orders is taken, so that a draw that moves far must keep its form. A couple
 * that costs more than 1 is rejected, unless it moves no farther than the nearest cheaper one in the order, plus that
 * one's size: patches of a surface that stretches.
 */
#pragma once

#include "look/between/groups.h"

/**
 * Find them, and couple those that are the only ones of their kind; the camera's motion is not known yet. @return 0
 * or ERR_SYSTEM (reported)
 */
int deforming_find(struct bridge *b, struct groups *kinds);

/** Couple the others. The camera must be known. @return 0 or ERR_SYSTEM (reported) */
int deforming_couple(struct bridge *b, const struct groups *kinds);
