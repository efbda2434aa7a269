/* Built-in names of GLSL: inputs, outputs, GL state (GLSL 1.20 sec. 7). */
#pragma once

#include "replay/glsl/writer.h"

/**
 * The value of a name that begins with gl_; elements of arrays are evenly spaced. .at NULL: there is none (w has
 * failed)
 */
struct glsl_value glsl_builtin(struct glsl_writer *w, const struct glsl_symbol *s);
/**
 * Remove constants that no instruction reads, except the first `keep`, and note which inputs are read. n_inputs: number
 * of inputs of the stage
 */
void glsl_prune(struct program_code *code, uint32_t keep, uint32_t n_inputs);
