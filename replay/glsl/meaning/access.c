#include "replay/glsl/meaning/access.h"

#include <string.h>

static const struct parse_type *element_of(struct parse *p, const struct parse_type *t)
{
	if (t->kind == GLSL_ARRAY)
		return t->element;
	if (t->kind <= GLSL_BOOL && t->columns)
		return parse_type(p, t->kind, t->rows, 0);
	if (!parse_type_is_vector(t))
		parse_error(p, "%s has no elements", parse_type_text(p, t));
	return parse_type(p, t->kind, 1, 0);
}

/* An array declared without a length gets the length that its largest index needs. */
static void note_index(struct parse *p, const struct parse_node *of, double index)
{
	if (of->operation != GLSL_SYMBOL)
		parse_error(p, "an array without a length is indexed inside another type");
	if (index >= PARSE_MAX_NUMBERS)
		parse_refuse(p, "a shader has an array that is too large");
	if (of->symbol->length <= index)
		of->symbol->length = (uint32_t)index + 1;
}

struct parse_node *parse_index(struct parse *p, struct parse_node *of, struct parse_node *index)
{
	const struct parse_type *t = of->type, *element = element_of(p, t);
	const uint32_t length = t->kind == GLSL_ARRAY ? t->length : t->columns ? t->columns : t->rows;
	const bool is_open = t->kind == GLSL_ARRAY && !t->length;

	if ((index->type->kind != GLSL_INT && index->type->kind != GLSL_UINT) || !parse_type_is_scalar(index->type))
		parse_error(p, "an index has type %s", parse_type_text(p, index->type));
	if (is_open && !parse_is_constant(index))
		parse_error(p, "an array is declared without a length and indexed by a variable");
	if (parse_is_constant(index)) {
		if (index->numbers[0] < 0 || (!is_open && index->numbers[0] >= length))
			parse_error(p, "the index %d is outside %s", (int)index->numbers[0], parse_type_text(p, t));
		if (is_open)
			note_index(p, of, index->numbers[0]);
		if (parse_is_constant(of))
			return parse_node_numbers(p, element,
			                          of->numbers + (uint32_t)index->numbers[0] * element->numbers);
	}
	return parse_node(p, GLSL_INDEX, element, 2, of, index);
}

static struct parse_node *swizzle(struct parse *p, struct parse_node *of, const struct parse_name *name)
{
	static const char sets[] = "xyzwrgbastpq";
	const struct parse_type *type;
	struct parse_node *node;
	uint32_t packed = 0, set = 0;
	double *numbers;

	for (uint32_t i = 0; i < name->n; i++) {
		const char *at = strchr(sets, name->text[i]);
		const uint32_t component = at ? (uint32_t)(at - sets) % 4 : 4;

		if (name->n > 4 || component >= of->type->rows || (i && (uint32_t)(at - sets) / 4 != set))
			parse_error(p, "'%s' does not select components of %s", name->text, parse_type_text(p, of->type));
		set = (uint32_t)(at - sets) / 4;
		packed |= component << 3 * i;
	}
	type = parse_type(p, of->type->kind, name->n, 0);
	if (!parse_is_constant(of)) {
		node = parse_node(p, GLSL_SWIZZLE, type, 1, of);
		node->value = packed;
		return node;
	}
	numbers = parse_alloc(p, name->n * sizeof(*numbers));
	for (uint32_t i = 0; i < name->n; i++)
		numbers[i] = of->numbers[packed >> 3 * i & 7];
	return parse_node_numbers(p, type, numbers);
}

struct parse_node *parse_member(struct parse *p, struct parse_node *of, const struct parse_name *name)
{
	const struct parse_structure *s = of->type->kind == GLSL_STRUCT ? of->type->structure : NULL;
	uint32_t first = 0;

	if (parse_type_is_vector(of->type) || (parse_type_is_scalar(of->type) && parse_has(p, 420, PARSE_PACK)))
		return swizzle(p, of, name);
	for (uint32_t i = 0; s && i < s->n; i++) {
		struct parse_node *node;

		if (s->members[i].name == name) {
			if (parse_is_constant(of))
				return parse_node_numbers(p, s->members[i].type, of->numbers + first);
			node = parse_node(p, GLSL_MEMBER, s->members[i].type, 1, of);
			node->value = i;
			return node;
		}
		first += s->members[i].type->numbers;
	}
	parse_error(p, "%s has no member '%s'", parse_type_text(p, of->type), name->text);
}

struct parse_node *parse_length(struct parse *p, const struct parse_node *of)
{
	const struct parse_type *t = of->type;

	if (t->kind == GLSL_ARRAY && t->length && p->version >= 120)
		return parse_node_number(p, GLSL_INT, t->length);
	if (t->kind <= GLSL_BOOL && t->rows > 1 && parse_has(p, 420, PARSE_PACK))
		return parse_node_number(p, GLSL_INT, t->columns ? t->columns : t->rows);
	parse_error(p, "%s has no length", parse_type_text(p, t));
}
