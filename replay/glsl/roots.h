/* Simplification of squares of square roots, as in Mesa. */
#pragma once

#include "replay/programs/code.h"

/**
 * Replace the square of a square root by its argument, as Mesa does (22.3.6, nir_opt_algebraic): the results differ in
 * the last bit. There must be no jump or mask between them. Code of more than 16,384 instructions is left unchanged.
 * @return 0 or ERR_SYSTEM (reported)
 */
int glsl_square_roots(struct program_code *code);
