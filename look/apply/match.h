/* Which rules concern an instance. */
#pragma once

#include "look/apply/applying.h"

/**
 * What the rules need to know of a frame before they apply: where its world is, which lights change, whether a mirror
 * is there.
 * @param a  `look` and `scene` are set; end with match_end, also after an error
 * @return 0 or ERR_SYSTEM (reported)
 */
int match_begin(struct applying *a);
void match_end(struct applying *a);

/** 1 where the k-th rule of surfaces changes an instance. */
int match_applies(const struct applying *a, const struct scene_instance *in, uint32_t k);
