/* Type specifiers, including structures (GLSL 1.50 sec. 4.1). */
#pragma once

#include "replay/glsl/parse/qualifiers.h"

struct parse_members {
	struct parse_member *at;
	uint32_t n, room;
};

/** Parse the members of a structure or block, up to '}'. */
void parse_members(struct parse *p, bool is_block, struct parse_members *list);

/** Parse a type with its brackets, which may declare a structure. Reports an error if there is no type. */
const struct parse_type *parse_specifier(struct parse *p);

/** True if the current token begins a declaration in a function. */
bool parse_begins_declaration(struct parse *p);
