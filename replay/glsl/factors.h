/* Factoring of sums of products that share a factor, as in Mesa. */
#pragma once

#include "replay/programs/code.h"

/**
 * Replace a b + a c by a (b + c), as Mesa does (22.3.6 and 25.0.7, nir_opt_algebraic): the results differ in the last
 * bit. No jump or mask may come between the products and their sum. Code of more than 16,384 instructions is left
 * unchanged.
 * @return 0 or ERR_SYSTEM (reported)
 */
int glsl_share_factors(struct program_code *code);
