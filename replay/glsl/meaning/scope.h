/*
 * What names mean where the text has come to. Scope 0 is the language's own, 1 the unit's, further ones those of
 * functions and blocks.
 */
#pragma once

#include "replay/glsl/meaning/nodes.h"

struct parse_binding {
	struct parse_binding *outer, *last; /* of the same name, further out; bound before this one */
	struct parse_name *name;
	uint32_t scope;
	struct parse_symbol *symbol;   /* a variable, or */
	const struct parse_type *type; /* a structure's type */
};

/** Forget what the unit before has bound. */
void parse_scope_reset(struct parse *p);

void parse_scope_open(struct parse *p);
void parse_scope_close(struct parse *p);

/** Bind a name in the innermost scope. One of both is given. Ends where the scope has the name. */
void parse_bind(struct parse *p, struct parse_name *name, struct parse_symbol *symbol, const struct parse_type *type);

/** A new variable, bound to nothing. */
struct parse_symbol *parse_symbol(struct parse *p, struct parse_name *name, const struct parse_type *type,
                                  enum glsl_storage storage);
