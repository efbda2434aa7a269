/* Access to parts of values: elements, members, components. */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** The element of[index]. */
struct parse_node *parse_index(struct parse *p, struct parse_node *of, struct parse_node *index);

/** The member, or components, of.name. */
struct parse_node *parse_member(struct parse *p, struct parse_node *of, const struct parse_name *name);

/** The call of.length(). */
struct parse_node *parse_length(struct parse *p, const struct parse_node *of);
