/* Translation of statements and functions (GLSL 1.20 sec. 6). */
#pragma once

#include "replay/glsl/writer.h"

void glsl_statement(struct glsl_writer *w, uint32_t node);
/** The statements of a function, up to its end or to where the last pixel has returned. */
void glsl_body(struct glsl_writer *w, const struct glsl_function *f);
struct glsl_value glsl_call(struct glsl_writer *w, const struct glsl_node *node);
/** The value of ?:, && or || with side effects: only one side is evaluated. */
struct glsl_value glsl_choose(struct glsl_writer *w, const struct glsl_node *node);
