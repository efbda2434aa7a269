/* Constructors (GLSL 1.20 sec. 5.4). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** Construct a value of a type. An array without a length gets its length from the number of values. */
struct parse_node *parse_construct(struct parse *p, const struct parse_type *type, const struct parse_nodes *values);
