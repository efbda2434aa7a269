/* Differences in OpenGL's state between two replays. */
#pragma once

#include "base/table.h"
#include "replay/machine/state.h"
#include "verbs/bisect/names.h"

/**
 * Compare the state of two contexts.
 * @param names    pairs of differently numbered objects that are the same; none are added
 * @param known    members that differ, by a hash of their path; those already in it are not reported again
 * @param text     receives "color.dst_rgb: 0x1, 0x303" and so on, a line each, freed by the caller; NULL: nothing new
 * @return 0 or ERR_SYSTEM (reported)
 */
int states_compare(const struct gls_state *good, const struct gls_state *bad, const struct names *names,
                   struct table *known, char **text);
