/* What of OpenGL's state differs between two replays. */
#pragma once

#include "base/table.h"
#include "bisect/names.h"
#include "replay/machine/state.h"

/**
 * Compare the state of two contexts.
 * @param names    objects that are numbered differently and are the same; it learns none
 * @param known    members that differ, by a hash of their path: those that were met before are not told again
 * @param text     receives "color.dst_rgb: 0x1, 0x303" and so on, a line each; the caller frees it; NULL where nothing new differs
 * @return 0 or ERR_SYSTEM (reported)
 */
int states_compare(const struct gls_state *good, const struct gls_state *bad, const struct names *names, struct table *known, char **text);
