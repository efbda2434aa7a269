/* Parser for expressions (GLSL 1.50 sec. 5, grammar in sec. 9). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

struct parse_node *parse_expression(struct parse *p);

/** An expression without top-level commas. */
struct parse_node *parse_assignment(struct parse *p);

/** A constant integer that is valid as an array's length. */
uint32_t parse_constant_length(struct parse *p);

/** Parse any [..] after a type or a name. @return the resulting type; [] gives length 0 */
const struct parse_type *parse_array_lengths(struct parse *p, const struct parse_type *type);

/** Parse a built-in type or a structure's name, without brackets. @return NULL: not a type; nothing was consumed */
const struct parse_type *parse_named_type(struct parse *p);

/** True if a token names a type. */
bool parse_names_type(const struct parse *p, const struct parse_token *token);
