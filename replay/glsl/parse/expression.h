/* Expressions (GLSL 1.50 sec. 5, grammar in sec. 9). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

struct parse_node *parse_expression(struct parse *p);

/** One without commas of its own. */
struct parse_node *parse_assignment(struct parse *p);

/** A whole number that is known now, and may be an array's length. */
uint32_t parse_constant_length(struct parse *p);

/** [..] behind a type or a name, if any: the type that it makes. [] is length 0 */
const struct parse_type *parse_array_lengths(struct parse *p, const struct parse_type *type);

/** A type of the language, or a structure's name, without brackets. @return NULL: the token names none; nothing was
 * taken */
const struct parse_type *parse_named_type(struct parse *p);

/** Whether a token names a type. */
bool parse_names_type(const struct parse *p, const struct parse_token *token);
