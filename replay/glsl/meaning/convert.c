#include "replay/glsl/meaning/convert.h"

#include "replay/glsl/meaning/fold.h"

void parse_need_place(struct parse *p, const struct parse_node *node)
{
	struct parse_symbol *s = parse_node_root(node);

	if (!s)
		parse_error(p, "the target of an assignment is not a variable");
	if (s->is_fixed || s->storage == GLSL_UNIFORM || s->storage == GLSL_INPUT || s->storage == GLSL_CONSTANT_VALUE)
		parse_error(p, "'%s' cannot be assigned", s->name->text);
	s->is_assigned = true;
	p->assigns_color |= p->stage == GLSL_FRAGMENT_STAGE && s->storage == GLSL_OUTPUT && !s->is_built_in;
	for (; node->operation != GLSL_SYMBOL; node = node->children[0])
		for (uint32_t i = 0; node->operation == GLSL_SWIZZLE && i < node->type->rows; i++)
			for (uint32_t k = 0; k < i; k++)
				if ((node->value >> 3 * i & 7) == (node->value >> 3 * k & 7))
					parse_error(p, "a component of '%s' is assigned twice", s->name->text);
}

bool parse_may_convert(const struct parse *p, const struct parse_type *from, const struct parse_type *to)
{
	if (from == to)
		return true;
	if (p->version < 120 || p->is_es || from->kind > GLSL_BOOL || to->kind > GLSL_BOOL || from->rows != to->rows ||
	    from->columns != to->columns)
		return false;
	if (to->kind == GLSL_UINT)
		return from->kind == GLSL_INT && parse_has(p, 400, PARSE_GPU_SHADER5);
	return to->kind == GLSL_FLOAT && (from->kind == GLSL_INT || from->kind == GLSL_UINT);
}

struct parse_node *parse_convert(struct parse *p, struct parse_node *node, enum glsl_kind kind)
{
	const struct parse_type *from = node->type, *to;

	if (from->kind == kind || from->kind > GLSL_BOOL || kind > GLSL_BOOL)
		return node;
	to = parse_type(p, kind, from->rows, from->columns);
	return parse_is_constant(node) ? parse_fold_convert(p, node, to) : parse_node(p, GLSL_CONVERT, to, 1, node);
}

struct parse_node *parse_convert_to(struct parse *p, struct parse_node *node, const struct parse_type *to)
{
	if (!parse_may_convert(p, node->type, to))
		parse_error(p, "a value of type %s where %s is expected", parse_type_text(p, node->type),
		            parse_type_text(p, to));
	return node->type == to ? node : parse_convert(p, node, to->kind);
}
