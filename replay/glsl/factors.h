/* What Mesa makes of products that are added and share a factor. */
#pragma once

#include "replay/programs/code.h"

/**
 * a b + a c becomes a (b + c), as Mesa (22.3.6 and 25.0.7, nir_opt_algebraic) has it: they differ in the last bit. The
 * products must be made where nothing jumps or masks before they are added. Code of more than 16,384 instructions stays
 * as it is.
 * @return 0 or ERR_SYSTEM (reported)
 */
int glsl_share_factors(struct program_code *code);
