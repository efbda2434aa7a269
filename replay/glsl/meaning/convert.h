/* Where a value may stand: conversions that the text does not name (GLSL 1.20 sec. 4.1.10), and what can be assigned.
 */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** End unless a node can be assigned. */
void parse_need_place(struct parse *p, const struct parse_node *node);

/** Whether a value of one type may stand where one of another is wanted (GLSL 1.20 sec. 4.1.10). */
bool parse_may_convert(const struct parse *p, const struct parse_type *from, const struct parse_type *to);

/** A node whose numbers are of this kind. */
struct parse_node *parse_convert(struct parse *p, struct parse_node *node, enum glsl_kind kind);

/** The same, by the rules: ends where there is no implicit conversion. */
struct parse_node *parse_convert_to(struct parse *p, struct parse_node *node, const struct parse_type *to);
