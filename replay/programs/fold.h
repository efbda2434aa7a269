/* Constant folding for assembly programs, with Mesa's results (22.3.6). */
#pragma once

struct program_code;

/**
 * Replace powers, exponentials, logarithms, sines and cosines of constants by the C library's results. Mesa folds
 * constants with the C library (nir_opcodes.py), and llvmpipe's own functions differ: 0 to the power of 0 is 1 there,
 * and 0 here.
 * @param code  without jumps and masks
 * @return 0 or ERR_SYSTEM: out of memory (reported)
 */
int program_fold(struct program_code *code);
