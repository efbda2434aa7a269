/* Implicit conversions (GLSL 1.20 sec. 4.1.10), and what can be assigned. */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** Report an error unless a node can be assigned. */
void parse_need_place(struct parse *p, const struct parse_node *node);

/** True if a value of one type is accepted where another type is expected (GLSL 1.20 sec. 4.1.10). */
bool parse_may_convert(const struct parse *p, const struct parse_type *from, const struct parse_type *to);

/** Convert a node's numbers to this kind. */
struct parse_node *parse_convert(struct parse *p, struct parse_node *node, enum glsl_kind kind);

/** Convert implicitly; reports an error if there is no implicit conversion. */
struct parse_node *parse_convert_to(struct parse *p, struct parse_node *node, const struct parse_type *to);
