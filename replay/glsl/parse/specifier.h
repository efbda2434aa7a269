/* Types as declarations name them, structures among them (GLSL 1.50 sec. 4.1). */
#pragma once

#include "replay/glsl/parse/qualifiers.h"

struct parse_members {
	struct parse_member *at;
	uint32_t n, room;
};

/** Members of a structure or of a block, up to '}'. */
void parse_members(struct parse *p, bool is_block, struct parse_members *list);

/** A type with its brackets, which may declare a structure. Ends where the token begins none. */
const struct parse_type *parse_specifier(struct parse *p);

/** Whether the token that is looked at begins a declaration, in a function. */
bool parse_begins_declaration(struct parse *p);
