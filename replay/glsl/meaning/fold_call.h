/*
 * Constant folding of built-in functions, in 32 bits, step by step; inverse trigonometric functions with Mesa's
 * polynomials (22.3.6).
 */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** @param arguments  constants. @return NULL: this function is not folded */
struct parse_node *parse_fold_call(struct parse *p, enum glsl_operator operation, const struct parse_type *type,
                                   const struct parse_nodes *arguments);
