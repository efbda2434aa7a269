/* Translation of expressions: values and assignable places (GLSL 1.20 sec. 5). */
#pragma once

#include "replay/glsl/writer.h"

/** The value of an expression; valid until a variable is assigned. */
struct glsl_value glsl_expression(struct glsl_writer *w, uint32_t node);
struct glsl_place glsl_place_of(struct glsl_writer *w, uint32_t node);
struct glsl_value glsl_variable(struct glsl_writer *w, uint32_t symbol);
struct glsl_value glsl_load(struct glsl_writer *w, const struct glsl_place *p);
void glsl_store(struct glsl_writer *w, const struct glsl_place *p, const struct glsl_value *v);
/** 1 if a node assigns something. */
bool glsl_has_effects(const struct glsl_writer *w, uint32_t node);
