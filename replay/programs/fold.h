/* Numbers of a program in assembly that are known before it runs, as Mesa (22.3.6) computes them. */
#pragma once

struct program_code;

/**
 * Replace powers, exponentials, logarithms and turns of known numbers by what the C library makes of them: Mesa folds
 * constants with it (nir_opcodes.py), and llvmpipe's own functions differ: 0 to the power of 0 is 1 there, and 0 here.
 * @param code  without jumps and masks
 * @return 0 or ERR_SYSTEM: out of memory (reported)
 */
int program_fold(struct program_code *code);
