/* The state of one context in a snapshot. */
#pragma once

#include "replay/index/snapshot_parts.h"

void snapshot_put_state(struct saver *s, const struct gls_state *st);

/** @param st  as gls_state_init made it */
void snapshot_get_state(struct loader *l, struct gls_state *st);
