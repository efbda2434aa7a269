/* Concatenates the rules of several files. */
#pragma once

#include "look/rules/rules.h"

/**
 * Append rules to others; surfaces and lights apply in order. There is only one `sky`, `gloss`, `spare` and
 * `replace`: the later one wins.
 * @param to    if it points to NULL, `more` is moved to it
 * @param more  consumed and set to NULL; if it points to NULL, nothing is added
 * @return 0 or ERR_SYSTEM (reported); call rules_free for both in any case
 */
int rules_join(struct look **to, struct look **more);
