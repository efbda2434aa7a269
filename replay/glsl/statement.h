/* Statements and functions (GLSL 1.20 sec. 6). */
#pragma once

#include "replay/glsl/writer.h"

void glsl_statement(struct glsl_writer *w, uint32_t node);
/** The statements of a function, to its end or to where the last pixel has returned. */
void glsl_body(struct glsl_writer *w, const struct glsl_function *f);
struct glsl_value glsl_call(struct glsl_writer *w, const struct glsl_node *node);
/** What ?:, && or || choose where that has effects: only one side is computed. */
struct glsl_value glsl_choose(struct glsl_writer *w, const struct glsl_node *node);
