/* Built-in functions (GLSL 1.20 sec. 8). */
#pragma once

#include "replay/glsl/writer.h"

/** A built-in function of values that were computed. */
struct glsl_value glsl_call_builtin(struct glsl_writer *w, const struct glsl_node *node, const struct glsl_value *a,
                                    uint32_t n);
/** Those that sample textures. */
struct glsl_value glsl_sample(struct glsl_writer *w, const struct glsl_node *node, const struct glsl_value *a,
                              uint32_t n);
