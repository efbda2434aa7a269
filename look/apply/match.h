/* Selects the rules that apply to an instance. */
#pragma once

#include "look/apply/applying.h"

/**
 * Collect what the rules need to know about a frame: its place in the world, which lights change, whether there is a
 * mirror.
 * @param a  with `look` and `scene` set; call match_end even after an error
 * @return 0 or ERR_SYSTEM (reported)
 */
int match_begin(struct applying *a);
void match_end(struct applying *a);

/** 1 if the k-th rule for surfaces applies to an instance. */
int match_applies(const struct applying *a, const struct scene_instance *in, uint32_t k);
