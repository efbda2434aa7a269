#include "replay/glsl/meaning/nodes.h"

#include <stdarg.h>

void parse_nodes_add(struct parse *p, struct parse_nodes *list, struct parse_node *node)
{
	list->at = parse_grow(p, list->at, list->n, &list->room, sizeof(struct parse_node *));
	list->at[list->n++] = node;
}

struct parse_node *parse_node_of(struct parse *p, enum glsl_operator operation, const struct parse_type *type,
                                 const struct parse_nodes *children)
{
	struct parse_node *node = parse_alloc(p, sizeof(*node));

	*node = (struct parse_node){ .operation = operation, .type = type, .n = children->n, .children = children->at };
	for (uint32_t i = 0; i < node->n; i++)
		if (node->children[i] && node->children[i]->depth > node->depth)
			node->depth = node->children[i]->depth;
	if (++node->depth > PARSE_MAX_DEPTH)
		parse_refuse(p, "a shader is nested too deeply");
	return node;
}

struct parse_node *parse_node(struct parse *p, enum glsl_operator operation, const struct parse_type *type, uint32_t n,
                              ...)
{
	struct parse_nodes children = { parse_alloc(p, n * sizeof(struct parse_node *)), n, n };
	va_list arguments;

	va_start(arguments, n);
	for (uint32_t i = 0; i < n; i++)
		children.at[i] = va_arg(arguments, struct parse_node *);
	va_end(arguments);
	return parse_node_of(p, operation, type, &children);
}

struct parse_node *parse_node_symbol(struct parse *p, struct parse_symbol *symbol)
{
	struct parse_node *node = parse_node(p, GLSL_SYMBOL, symbol->type, 0);

	node->symbol = symbol;
	return node;
}

struct parse_node *parse_node_numbers(struct parse *p, const struct parse_type *type, const double *numbers)
{
	struct parse_node *node = parse_node(p, GLSL_NUMBERS, type, 0);

	node->numbers = numbers;
	return node;
}

struct parse_node *parse_node_number(struct parse *p, enum glsl_kind kind, double value)
{
	double *number = parse_alloc(p, sizeof(*number));

	*number = value;
	return parse_node_numbers(p, parse_type(p, kind, 1, 0), number);
}

bool parse_are_constant(const struct parse_nodes *list)
{
	for (uint32_t i = 0; i < list->n; i++)
		if (!parse_is_constant(list->at[i]))
			return false;
	return true;
}

struct parse_symbol *parse_node_root(const struct parse_node *node)
{
	while (node->operation == GLSL_INDEX || node->operation == GLSL_MEMBER || node->operation == GLSL_SWIZZLE)
		node = node->children[0];
	return node->operation == GLSL_SYMBOL ? node->symbol : NULL;
}
