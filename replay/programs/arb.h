/* Translation of ARB assembly programs: ARB_vertex_program, section 2.14.2; ARB_fragment_program, section 3.11.2. */
#pragma once

#include <stddef.h>

struct program_code;

/**
 * Translate the text of a program.
 * @param text  n bytes, not trusted
 * @param is_vertex  1: a vertex program; 0: a fragment program
 * @param code  all zero; filled in, and to be freed with program_code_free whatever is returned
 * @param why   receives NULL, or the reason why the program cannot be run: a static string
 * @return 0, also if *why is set, or ERR_SYSTEM: out of memory (reported)
 */
int program_translate_arb(const char *text, size_t n, int is_vertex, struct program_code *code, const char **why);
