/*
 * Name lookup at the current point of the text. Scope 0 is that of the language, 1 that of the unit; further ones
 * belong to functions and blocks.
 */
#pragma once

#include "replay/glsl/meaning/nodes.h"

struct parse_binding {
	struct parse_binding *outer, *last; /* outer: of the same name, in an outer scope; last: bound before this one */
	struct parse_name *name;
	uint32_t scope;
	struct parse_symbol *symbol;   /* a variable, or */
	const struct parse_type *type; /* the type of a structure */
};

/** Drop the bindings of the previous unit. */
void parse_scope_reset(struct parse *p);

void parse_scope_open(struct parse *p);
void parse_scope_close(struct parse *p);

/**
 * Bind a name in the innermost scope to either a symbol or a type. Reports an error if the scope already has the name.
 */
void parse_bind(struct parse *p, struct parse_name *name, struct parse_symbol *symbol, const struct parse_type *type);

/** A new variable, not bound to a name. */
struct parse_symbol *parse_symbol(struct parse *p, struct parse_name *name, const struct parse_type *type,
                                  enum glsl_storage storage);
