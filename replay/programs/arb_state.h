/*
 * GL state and parameters that an ARB program refers to: bindings of constants (tables X.1 to X.5 of both extensions).
 */
#pragma once

#include <stdint.h>

#include "replay/programs/code.h"

struct arb_words;

/**
 * Parse the rest of a binding after `state.` or `program.`, including a range of rows or parameters.
 * @param is_vertex  1: bindings of vertex programs; 0: of fragment programs
 * @param to    receives the constants
 * @param room  of `to`
 * @return number of constants; 0 after a failure (in w)
 */
uint32_t arb_state(struct arb_words *w, int is_vertex, struct program_constant *to, uint32_t room);
uint32_t arb_parameters(struct arb_words *w, struct program_constant *to, uint32_t room);
