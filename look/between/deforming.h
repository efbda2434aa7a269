/*
 * Draws that deform: whose points the other frame has nowhere, as those of fish or cloth, while their triangles and
 * texture coordinates stay. The price of a couple is 0 if nothing changes; it grows with the stretch of its edges,
 * as a share of their lengths, and with its way, as a share of its way and its size. A draw without a partner costs
 * half. So what moves far must keep its form. The cheapest alignment of both frames' orders is taken, kind by kind.
 */
#pragma once

#include "look/between/groups.h"

/** Find them, and couple those that are alone of their kind: how the camera moves is not known yet. @return 0 or
 * ERR_SYSTEM (reported) */
int deforming_find(struct bridge *b, struct groups *kinds);

/** Couple all. The camera is known. @return 0 or ERR_SYSTEM (reported) */
int deforming_couple(struct bridge *b, const struct groups *kinds);
