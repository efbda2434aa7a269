/* Applies a rule to a surface. */
#pragma once

#include "look/apply/applying.h"

/** @param spares  1 unless rules say `spare: no` */
void surface_set(struct scene_surface *s, const struct surface_rule *r, int spares);
