#include "replay/glsl/meaning/construct.h"

#include "replay/glsl/meaning/convert.h"
#include "replay/glsl/meaning/fold.h"

static struct parse_node *made(struct parse *p, const struct parse_type *type, const struct parse_nodes *values)
{
	return parse_are_constant(values) ? parse_fold_construct(p, type, values) :
	                                    parse_node_of(p, GLSL_CONSTRUCT, type, values);
}

static struct parse_node *construct_parts(struct parse *p, const struct parse_type *type,
                                          const struct parse_nodes *values)
{
	const uint32_t n = type->kind == GLSL_ARRAY ? type->length : type->structure->n;
	struct parse_nodes converted = { 0 };

	if (n != values->n || type->holds_sampler)
		parse_error(p, "a constructor of %s has %u values, not %u", parse_type_text(p, type), values->n, n);
	for (uint32_t i = 0; i < n; i++) {
		const struct parse_type *part = type->kind == GLSL_ARRAY ? type->element :
		                                                           type->structure->members[i].type;

		parse_nodes_add(p, &converted, parse_convert_to(p, values->at[i], part));
	}
	return made(p, type, &converted);
}

static void check_numbers(struct parse *p, const struct parse_type *type, const struct parse_nodes *values)
{
	const bool from_matrix = type->columns && values->n == 1 && values->at[0]->type->columns;
	uint32_t given = 0;

	if (from_matrix && p->version < 120)
		parse_error(p, "a matrix is constructed from a matrix, which needs GLSL 1.20");
	for (uint32_t i = 0; i < values->n; i++) {
		const struct parse_type *from = values->at[i]->type;

		if (from->kind == GLSL_VOID || from->kind > GLSL_BOOL)
			parse_error(p, "a constructor of %s does not take %s", parse_type_text(p, type),
			            parse_type_text(p, from));
		if (type->columns && from->columns && values->n > 1)
			parse_error(p, "a matrix is constructed from a matrix and something else");
		if (given >= type->numbers)
			parse_error(p, "a constructor of %s has more values than it takes", parse_type_text(p, type));
		given += from->numbers;
	}
	if (given < type->numbers && !from_matrix && !(values->n == 1 && given == 1))
		parse_error(p, "a constructor of %s has too few values", parse_type_text(p, type));
}

struct parse_node *parse_construct(struct parse *p, const struct parse_type *type, const struct parse_nodes *values)
{
	struct parse_nodes converted = { 0 };

	if (type->kind == GLSL_ARRAY && !type->length)
		type = parse_type_array(p, type->element, values->n);
	if (type->kind == GLSL_ARRAY || type->kind == GLSL_STRUCT)
		return construct_parts(p, type, values);
	if (type->kind == GLSL_VOID || type->kind > GLSL_BOOL)
		parse_error(p, "%s has no constructor", parse_type_text(p, type));
	check_numbers(p, type, values);
	for (uint32_t i = 0; i < values->n; i++)
		parse_nodes_add(p, &converted, parse_convert(p, values->at[i], type->kind));
	if (values->n == 1 && converted.at[0] != values->at[0] && converted.at[0]->type == type)
		return converted.at[0];
	return made(p, type, &converted);
}
