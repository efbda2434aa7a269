/* What Mesa makes of square roots that are multiplied by themselves. */
#pragma once

#include "replay/programs/code.h"

/**
 * The square of a square root becomes its argument, as Mesa (22.3.6, nir_opt_algebraic) has it: they differ in the last
 * bit. Both must stand where nothing jumps or masks between them. Code of more than 16,384 instructions stays as it is.
 * @return 0 or ERR_SYSTEM (reported)
 */
int glsl_square_roots(struct program_code *code);
