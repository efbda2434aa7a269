/* What an ARB program names of GL's state and of its parameters: bindings of constants (tables X.1 to X.5 of both
 * extensions). */
#pragma once

#include <stdint.h>

#include "replay/programs/code.h"

struct arb_words;

/**
 * Take what follows `state.` or `program.`, a range of rows or of parameters where the text has one.
 * @param is_vertex  1: what vertex programs may name; 0: fragment programs
 * @param to    receives the constants
 * @param room  of `to`
 * @return how many; 0 after a failure (in w)
 */
uint32_t arb_state(struct arb_words *w, int is_vertex, struct program_constant *to, uint32_t room);
uint32_t arb_parameters(struct arb_words *w, struct program_constant *to, uint32_t room);
