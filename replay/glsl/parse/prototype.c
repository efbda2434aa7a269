#include "replay/glsl/parse/prototype.h"

#include "replay/glsl/meaning/scope.h"
#include "replay/glsl/parse/expression.h"
#include "replay/glsl/parse/parser.h"
#include "replay/glsl/parse/specifier.h"

struct parameters {
	struct parse_symbol **at;
	uint32_t n, room;
};

static struct parse_symbol *read_parameter(struct parse *p)
{
	const struct parse_qualifiers q = parse_qualifiers(p);
	const enum glsl_storage storage = parse_parameter_storage(p, &q);
	const struct parse_type *type = parse_specifier(p);
	struct parse_name *name = parse_is_sign(&p->now, ',') || parse_is_sign(&p->now, ')') ||
	                                          parse_is_sign(&p->now, '[') ?
	                                  parse_name(p, "", 0) :
	                                  parse_identifier(p);
	struct parse_symbol *s;

	type = parse_array_lengths(p, type);
	if (type->kind == GLSL_VOID || (type->kind == GLSL_ARRAY && !type->length) ||
	    (type->holds_sampler && storage != GLSL_IN))
		parse_error(p, "a parameter has type %s", parse_type_text(p, type));
	s = parse_symbol(p, name, type, storage);
	s->is_fixed = q.is_const || type->holds_sampler;
	return s;
}

/* Parse parameters after '(', up to ')'. */
static struct parameters read_parameters(struct parse *p)
{
	struct parameters list = { 0 };

	if (parse_is_word(&p->now, "void") && parse_is_sign(parse_peek(p), ')'))
		parse_advance(p);
	if (parse_accept(p, ')'))
		return list;
	do {
		list.at = parse_grow(p, list.at, list.n, &list.room, sizeof(*list.at));
		list.at[list.n++] = read_parameter(p);
	} while (parse_accept(p, ','));
	parse_expect(p, ')');
	return list;
}

struct parse_function *parse_prototype(struct parse *p, const struct parse_qualifiers *q,
                                       const struct parse_type *result, struct parse_name *name)
{
	const struct parameters list = read_parameters(p);

	if (q->any_storage)
		parse_error(p, "the function '%s' has a storage qualifier", name->text);
	if (result->holds_sampler || (result->kind == GLSL_ARRAY && (!result->length || p->version < 120)))
		parse_error(p, "'%s' returns %s", name->text, parse_type_text(p, result));
	return parse_declare_function(p, name, result, list.at, list.n, parse_is_sign(&p->now, '{'));
}
