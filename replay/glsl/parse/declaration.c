#include "replay/glsl/parse/declaration.h"

#include <string.h>

#include "replay/glsl/meaning/convert.h"
#include "replay/glsl/meaning/scope.h"
#include "replay/glsl/parse/expression.h"
#include "replay/glsl/parse/parser.h"
#include "replay/glsl/parse/prototype.h"
#include "replay/glsl/parse/specifier.h"
#include "replay/glsl/text/keywords.h"

/* --- Variables ---------------------------------------------------------------------------------------------------- */

/* Redeclare a built-in variable, or an array without a length. */
static void redeclare(struct parse *p, struct parse_symbol *s, const struct parse_qualifiers *q,
                      const struct parse_type *type, enum glsl_storage storage)
{
	const bool gets_length = type->kind == GLSL_ARRAY && s->type->kind == GLSL_ARRAY && !s->type->length &&
	                         type->element == s->type->element;

	if (!s->is_built_in && !(type->kind == GLSL_ARRAY && s->type->kind == GLSL_ARRAY))
		parse_error(p, "'%s' is declared twice", s->name->text);
	if ((type != s->type && !gets_length) || storage != s->storage)
		parse_error(p, "'%s' is already declared differently", s->name->text);
	if (type == s->type && !s->is_built_in && !(type->kind == GLSL_ARRAY && !type->length))
		parse_error(p, "'%s' is declared twice", s->name->text);
	if (gets_length && type->length &&
	    (type->length < s->length || (strcmp(s->name->text, "gl_TexCoord") == 0 && type->length > 8)))
		parse_error(p, "'%s' is indexed beyond its length, or longer than it can be", s->name->text);
	if (gets_length && type->length)
		s->type = type;
	if (s->is_built_in && (q->flat || q->straight))
		parse_refuse(p, "a shader has inputs without perspective interpolation");
}

/* The symbol of the same name in another unit of the stage. */
static struct parse_symbol *shared_symbol(struct parse *p, struct parse_symbol *s, const struct parse_type *type,
                                          enum glsl_storage storage)
{
	const bool are_arrays = type->kind == GLSL_ARRAY && s->type->kind == GLSL_ARRAY &&
	                        type->element == s->type->element;

	if (storage != s->storage || (type != s->type && !(are_arrays && (!type->length || !s->type->length))))
		parse_link_error(p, "'%s' is declared in different ways", s->name->text);
	if (are_arrays && type->length)
		s->type = type;
	if (s->type->kind == GLSL_ARRAY && s->type->length && s->type->length < s->length)
		parse_link_error(p, "'%s' is indexed beyond its length", s->name->text);
	return s;
}

static struct parse_symbol *declare(struct parse *p, struct parse_name *name, const struct parse_qualifiers *q,
                                    const struct parse_type *type, enum glsl_storage storage)
{
	const struct parse_binding *before = name->binding;
	const bool is_global = p->scope <= 1;
	struct parse_symbol *s = NULL;

	if (before && before->symbol && (before->scope == p->scope || (is_global && before->symbol->is_built_in))) {
		redeclare(p, before->symbol, q, type, storage);
		return before->symbol;
	}
	if (is_global && storage != GLSL_CONSTANT_VALUE && name->global)
		s = shared_symbol(p, name->global, type, storage);
	if (!s)
		s = parse_symbol(p, name, type, storage);
	if (is_global && storage != GLSL_CONSTANT_VALUE)
		name->global = s;
	s->flat |= q->flat;
	s->straight |= q->straight;
	s->location = q->location != GLSL_NONE ? q->location : s->location;
	s->binding = q->binding != GLSL_NONE ? q->binding : s->binding;
	return s;
}

static void check_type(struct parse *p, const struct parse_name *name, const struct parse_qualifiers *q,
                       const struct parse_type *type, enum glsl_storage storage)
{
	if (type->kind == GLSL_VOID)
		parse_error(p, "'%s' is void", name->text);
	if (type->holds_sampler && storage != GLSL_UNIFORM)
		parse_error(p, "the sampler '%s' is not a uniform", name->text);
	for (const struct parse_type *t = type->kind == GLSL_ARRAY ? type->element : NULL; t && t->kind == GLSL_ARRAY;
	     t = t->element)
		if (!t->length)
			parse_error(p, "'%s' has an inner array without a length", name->text);
	parse_check_link(p, q, storage, type);
}

/* @return the node that initializes a variable at run time; NULL: none is needed */
static struct parse_node *initialize(struct parse *p, struct parse_symbol *s, struct parse_node *value)
{
	struct parse_node *node;

	if (s->type->kind == GLSL_ARRAY && !s->type->length && value->type->kind == GLSL_ARRAY &&
	    value->type->element == s->type->element)
		s->type = value->type;
	if (s->type->kind == GLSL_ARRAY && p->version < 120)
		parse_error(p, "an initializer of an array needs GLSL 1.20");
	value = parse_convert_to(p, value, s->type);
	if (s->storage == GLSL_UNIFORM || s->storage == GLSL_CONSTANT_VALUE) {
		if (parse_is_constant(value)) {
			s->numbers = value->numbers;
			return NULL;
		}
		if (s->storage == GLSL_UNIFORM || p->scope <= 1 || !parse_has(p, 420, PARSE_PACK))
			parse_error(p, "the initializer of '%s' is not constant", s->name->text);
		s->storage = GLSL_LOCAL;
		s->is_fixed = true;
	}
	node = parse_node(p, GLSL_ASSIGN, s->type, 2, parse_node_symbol(p, s), value);
	node->value = GLSL_ASSIGN;
	return node;
}

static enum glsl_storage storage_of(struct parse *p, const struct parse_qualifiers *q)
{
	if (p->scope <= 1)
		return parse_global_storage(p, q);
	if (q->is_attribute || q->is_uniform || q->is_varying || q->is_in || q->is_out || q->flat || q->smooth ||
	    q->straight)
		parse_error(p, "a local variable has an invalid storage qualifier");
	return q->is_const ? GLSL_CONSTANT_VALUE : GLSL_LOCAL;
}

/* Parse one variable, starting after its name. */
static void read_variable(struct parse *p, const struct parse_qualifiers *q, const struct parse_type *type,
                          struct parse_name *name, struct parse_nodes *list)
{
	const enum glsl_storage storage = storage_of(p, q);
	struct parse_symbol *s;
	struct parse_node *value = NULL, *node;

	type = parse_array_lengths(p, type);
	check_type(p, name, q, type, storage);
	s = declare(p, name, q, type, storage);
	if (parse_accept(p, '=')) {
		if (storage == GLSL_INPUT || storage == GLSL_OUTPUT || (storage == GLSL_UNIFORM && p->version < 120))
			parse_error(p, "'%s' cannot have an initializer", name->text);
		if (parse_is_sign(&p->now, '{'))
			parse_refuse(p, "a shader has initializer lists, which are not supported");
		value = parse_assignment(p); /* the new variable is not in scope here yet */
	} else if (storage == GLSL_CONSTANT_VALUE) {
		parse_error(p, "the constant '%s' has no value", name->text);
	}
	node = value ? initialize(p, s, value) : NULL;
	if (!name->binding || (name->binding->symbol != s))
		parse_bind(p, name, s, NULL);
	if (node)
		parse_nodes_add(p, list, node);
}

void parse_variables(struct parse *p, const struct parse_qualifiers *q, const struct parse_type *type,
                     struct parse_name *first, struct parse_nodes *list)
{
	read_variable(p, q, type, first, list);
	while (parse_accept(p, ','))
		read_variable(p, q, type, parse_identifier(p), list);
	parse_expect(p, ';');
}

void parse_local_declaration(struct parse *p, struct parse_nodes *list)
{
	const struct parse_qualifiers q = parse_qualifiers(p);
	const struct parse_type *type = parse_specifier(p);
	struct parse_name *name;

	if (parse_accept(p, ';'))
		return;
	name = parse_identifier(p);
	if (p->version >= 120 || !parse_accept(p, '(')) {
		parse_variables(p, &q, type, name, list);
		return;
	}
	parse_prototype(p, &q, type, name); /* GLSL 1.10 also allows them in functions */
	parse_expect(p, ';');
}

struct parse_node *parse_condition_variable(struct parse *p)
{
	const struct parse_qualifiers q = parse_qualifiers(p);
	const struct parse_type *type = parse_specifier(p);
	struct parse_nodes list = { 0 };
	struct parse_name *name = parse_identifier(p);

	if (!parse_is_sign(&p->now, '=') || q.is_const)
		parse_unexpected(p);
	read_variable(p, &q, type, name, &list);
	return list.at[0];
}

/*
 * --- Other declarations --------------------------------------------------------------------------------------------
 */

void parse_block(struct parse *p, const struct parse_qualifiers *q)
{
	struct parse_name *name = parse_identifier(p);
	const bool is_own = strcmp(name->text, "gl_PerVertex") == 0;
	struct parse_members members = { 0 };
	struct parse_symbol *s;

	if (!parse_has(p, q->is_uniform ? 140 : 150, q->is_uniform ? PARSE_BLOCKS : 0))
		parse_error(p, "blocks need GLSL 1.40 or 1.50");
	parse_expect(p, '{');
	parse_members(p, true, &members);
	if (parse_accept(p, ';')) {
		for (uint32_t i = 0; i < members.n && !is_own; i++) {
			s = parse_symbol(p, members.at[i].name, members.at[i].type, parse_global_storage(p, q));
			s->is_block = true;
			parse_bind(p, s->name, s, NULL);
		}
		return;
	}
	name = parse_identifier(p);
	s = parse_symbol(p, name, parse_array_lengths(p, parse_type(p, GLSL_FLOAT, 1, 0)), parse_global_storage(p, q));
	s->is_block = true;
	parse_bind(p, name, s, NULL);
	parse_expect(p, ';');
}

void parse_precision(struct parse *p)
{
	if (!parse_accept_word(p, PARSE_LOWP) || !parse_named_type(p))
		parse_unexpected(p);
	parse_expect(p, ';');
}
