/*
 * Draws that deform, as fish or cloth do: the other frame has their points nowhere, but their triangles and texture
 * coordinates. The price of a couple is 0 if nothing changes; it grows with the stretch of its edges, as a
 * share of their lengths, and with its way, as a share of its way and its size: each of the two is less than 1. A draw
 * without a partner costs half, or 1 if both frames have as many of its kind. The cheapest alignment of both frames'
 * orders is taken, kind by kind. So what moves far must keep its form. A couple that costs more than 1 is none, unless
 * it goes no farther than the nearest cheaper one in the order, and that one's size: patches of one surface that
 * stretches.
 */
#pragma once

#include "look/between/groups.h"

/** Find them, and couple those that are alone of their kind: how the camera moves is not known yet. @return 0 or
 * ERR_SYSTEM (reported) */
int deforming_find(struct bridge *b, struct groups *kinds);

/** Couple all. The camera is known. @return 0 or ERR_SYSTEM (reported) */
int deforming_couple(struct bridge *b, const struct groups *kinds);
