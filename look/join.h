/* Rules of several files, one after the other. */
#pragma once

#include "look/rules.h"

/**
 * Add rules behind others: surfaces and lights apply in order. Of `sky`, `gloss`, `spare` and `replace` there is one:
 * the later counts.
 * @param to    NULL there: `more` is moved to it
 * @param more  taken over and NULL then; NULL there: nothing is added
 * @return 0 or ERR_SYSTEM (reported); rules_free both in any case
 */
int rules_join(struct look **to, struct look **more);
