/*
 * Values of built-in functions that are known when the text is read. In 32 bits, step by step; arcs by Mesa's (22.3.6)
 * polynomials.
 */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** @param arguments  constants. @return NULL: this function is left to run */
struct parse_node *parse_fold_call(struct parse *p, enum glsl_operator operation, const struct parse_type *type,
                                   const struct parse_nodes *arguments);
