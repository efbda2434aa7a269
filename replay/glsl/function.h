/* Translation of built-in functions (GLSL 1.20 sec. 8). */
#pragma once

#include "replay/glsl/writer.h"

/** Call a built-in function with values that were computed. */
struct glsl_value glsl_call_builtin(struct glsl_writer *w, const struct glsl_node *node, const struct glsl_value *a,
                                    uint32_t n);
/** Call a built-in function that samples a texture. */
struct glsl_value glsl_sample(struct glsl_writer *w, const struct glsl_node *node, const struct glsl_value *a,
                              uint32_t n);
