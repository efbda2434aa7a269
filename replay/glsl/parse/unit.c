#include "replay/glsl/parse/unit.h"

#include "replay/glsl/meaning/functions.h"
#include "replay/glsl/meaning/scope.h"
#include "replay/glsl/parse/declaration.h"
#include "replay/glsl/parse/expression.h"
#include "replay/glsl/parse/parser.h"
#include "replay/glsl/parse/prelude.h"
#include "replay/glsl/parse/prototype.h"
#include "replay/glsl/parse/specifier.h"
#include "replay/glsl/parse/statement.h"
#include "replay/glsl/text/directive.h"
#include "replay/glsl/text/keywords.h"

/* --- Functions ---------------------------------------------------------------------------------------------------- */

static void read_body(struct parse *p, struct parse_function *f)
{
	struct parse_node *place = parse_node(p, GLSL_CALL, f->result, 0);

	parse_scope_open(p);
	for (uint32_t i = 0; i < f->n; i++)
		if (f->parameters[i]->name->n)
			parse_bind(p, f->parameters[i]->name, f->parameters[i], NULL);
	p->inside = f;
	p->returns = false;
	f->body = parse_statements(p);
	if (f->result->kind != GLSL_VOID && !p->returns)
		parse_error(p, "'%s' does not return a value", f->name->text);
	p->inside = NULL;
	parse_scope_close(p);
	place->function = f;
	parse_nodes_add(p, p->root, place);
}

/* Parse a function after its name and '('. */
static void read_function(struct parse *p, const struct parse_qualifiers *q, const struct parse_type *result,
                          struct parse_name *name)
{
	struct parse_function *f = parse_prototype(p, q, result, name);

	if (!parse_accept(p, '{'))
		parse_expect(p, ';');
	else
		read_body(p, f);
}

/* --- All declarations --------------------------------------------------------------------------------------------- */

/* Parse invariant NAME, NAME; */
static void read_invariant(struct parse *p)
{
	do {
		const struct parse_name *name = parse_identifier(p);

		const struct parse_symbol *s = name->binding ? name->binding->symbol : NULL;

		if (!s)
			parse_error(p, "'%s' is not declared", name->text);
		if (s->storage != GLSL_OUTPUT && !(s->storage == GLSL_INPUT && p->stage == GLSL_FRAGMENT_STAGE))
			parse_error(p, "'%s' is not passed between stages", name->text);
	} while (parse_accept(p, ','));
	parse_expect(p, ';');
}

static void read_declaration(struct parse *p)
{
	struct parse_qualifiers q;
	const struct parse_type *type;
	struct parse_name *name;

	if (parse_accept(p, ';'))
		return;
	if (parse_accept_word(p, PARSE_PRECISION)) {
		parse_precision(p);
		return;
	}
	q = parse_qualifiers(p);
	if (q.any && parse_accept(p, ';'))
		return;
	if (q.any && p->now.kind == PARSE_NAME && !parse_names_type(p, &p->now) &&
	    parse_keyword(p, &p->now) != PARSE_STRUCT) {
		if (parse_is_sign(parse_peek(p), '{'))
			parse_block(p, &q);
		else
			read_invariant(p);
		return;
	}
	type = parse_specifier(p);
	if (parse_accept(p, ';'))
		return;
	name = parse_identifier(p);
	if (parse_accept(p, '('))
		read_function(p, &q, type, name);
	else
		parse_variables(p, &q, type, name, p->root);
}

static void read_all(struct parse *p)
{
	parse_advance(p);
	while (p->now.kind != PARSE_END)
		read_declaration(p);
}

void parse_unit(struct parse *p, const char *text)
{
	struct parse_place begin;

	p->n_units++;
	p->has_next = false;
	parse_scope_reset(p);
	parse_directive_begin(p, text);
	begin = p->place;
	p->is_prelude = true;
	for (unsigned i = 0; i < parse_prelude_parts; i++) {
		const char *part = parse_prelude(p, i);

		if (part) {
			p->place = (struct parse_place){ part, 1, true };
			read_all(p);
		}
	}
	p->is_prelude = false;
	p->place = begin;
	p->line = 0;
	parse_scope_open(p);
	read_all(p);
	parse_scope_close(p);
}
