/* What GLSL's built-in names are of: inputs, outputs, state (GLSL 1.20 sec. 7). */
#pragma once

#include "replay/glsl/writer.h"

/** The value of a name that begins with gl_; elements of arrays are each as far from the last one. .at NULL: there is
 * none (w has failed) */
struct glsl_value glsl_builtin(struct glsl_writer *w, const struct glsl_symbol *s);
/** Leave out constants that no instruction reads, but for the first `keep`, and say which inputs are read. n_inputs: of
 * the stage */
void glsl_prune(struct program_code *code, uint32_t keep, uint32_t n_inputs);
