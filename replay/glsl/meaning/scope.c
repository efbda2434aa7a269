#include "replay/glsl/meaning/scope.h"

#include <string.h>

void parse_scope_reset(struct parse *p)
{
	p->scope = 0;
	p->bound = NULL;
	for (unsigned i = 0; i < PARSE_NAMES; i++)
		for (struct parse_name *name = p->names[i]; name; name = name->next) {
			name->macro = NULL;
			name->binding = NULL;
			name->functions = NULL;
		}
}

void parse_scope_open(struct parse *p)
{
	p->scope++;
}

void parse_scope_close(struct parse *p)
{
	for (; p->bound && p->bound->scope == p->scope; p->bound = p->bound->last)
		p->bound->name->binding = p->bound->outer;
	p->scope--;
}

void parse_bind(struct parse *p, struct parse_name *name, struct parse_symbol *symbol, const struct parse_type *type)
{
	struct parse_binding *b;

	if (!p->is_prelude && strncmp(name->text, "gl_", 3) == 0)
		parse_error(p, "'%s' is a reserved name", name->text);
	if ((name->binding && name->binding->scope == p->scope) ||
	    (p->scope == 1 && p->version >= 120 && name->functions))
		parse_error(p, "'%s' is declared twice", name->text);
	b = parse_alloc(p, sizeof(*b));
	*b = (struct parse_binding){ name->binding, p->bound, name, p->scope, symbol, type };
	p->bound = name->binding = b;
}

struct parse_symbol *parse_symbol(struct parse *p, struct parse_name *name, const struct parse_type *type,
                                  enum glsl_storage storage)
{
	struct parse_symbol *s = parse_alloc(p, sizeof(*s));

	*s = (struct parse_symbol){
		.name = name, .type = type, .storage = storage, .location = GLSL_NONE, .binding = GLSL_NONE
	};
	s->declared = p->n_declared++;
	s->is_built_in = strncmp(name->text, "gl_", 3) == 0;
	return s;
}
