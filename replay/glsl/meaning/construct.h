/* Constructors (GLSL 1.20 sec. 5.4). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** A value of a type made of others. An array without a length takes that of its values. */
struct parse_node *parse_construct(struct parse *p, const struct parse_type *type, const struct parse_nodes *values);
