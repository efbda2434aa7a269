/* Translation of operators, component-wise and for matrices (GLSL 1.20 sec. 5.9). */
#pragma once

#include "replay/glsl/writer.h"

/** A binary operator, component-wise or for matrices. */
struct glsl_value glsl_binary(struct glsl_writer *w, uint32_t operation, uint32_t type, const struct glsl_value *a,
                              const struct glsl_value *b);

/** f(a[i], b[i]) for each component, with scalars replicated; b may be NULL. flags: SCENE_NEGATE_A ... */
struct glsl_value glsl_by_component(struct glsl_writer *w, enum scene_operation operation, uint32_t flags,
                                    uint32_t type, const struct glsl_value *a, const struct glsl_value *b);

/** The operands of n components, with a scalar replicated. */
const uint32_t *glsl_spread(struct glsl_writer *w, const struct glsl_value *v, uint32_t n);
