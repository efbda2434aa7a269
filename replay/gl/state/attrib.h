/* Capabilities (GL 2.1 sec. 6.1.1): glEnable and glDisable. */
#pragma once

#include "replay/machine/commands.h"

gls_handler gls_glEnable, gls_glDisable;

/**
 * 1 if a capability already has this state. Mesa (22.3.6, enable.c) then returns before it empties its vertex store
 * (waiting.h).
 */
int gls_is_switched(struct gls_state *st, uint32_t cap, int on);
