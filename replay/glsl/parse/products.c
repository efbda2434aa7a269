#include "replay/glsl/parse/products.h"

#include "replay/glsl/meaning/functions.h"

#define MOST_STATEMENTS 64 /* largest distance between a product and its use: texts can be long */
#define MAX_NODES 200000

static void count(struct parse *p, const struct parse_node *node, uint32_t *n)
{
	if (!node)
		return;
	if (++*n > MAX_NODES)
		parse_refuse(p, "a shader is too large");
	if (node->operation == GLSL_SYMBOL)
		node->symbol->named++;
	for (uint32_t i = 0; i < node->n; i++)
		count(p, node->children[i], n);
}

static bool names(const struct parse_node *node, const struct parse_symbol *s)
{
	bool found = node && node->operation == GLSL_SYMBOL && node->symbol == s;

	for (uint32_t i = 0; node && !found && i < node->n; i++)
		found = names(node->children[i], s);
	return found;
}

/* True if a node has no branches, calls, increments or decrements. */
static bool is_straight(const struct parse_node *node)
{
	const enum glsl_operator operation = node ? node->operation : GLSL_SEQUENCE;
	bool straight = operation != GLSL_CALL && !(operation >= GLSL_SELECTION && operation <= GLSL_DISCARD) &&
	                !(operation >= GLSL_POST_INCREMENT && operation <= GLSL_PRE_DECREMENT);

	for (uint32_t i = 0; node && straight && i < node->n; i++)
		straight = is_straight(node->children[i]);
	return straight;
}

/* True if a node assigns something that a product uses. product: NULL: anything */
static bool writes(const struct parse_node *node, const struct parse_node *product)
{
	bool found = false;

	if (node && node->operation == GLSL_ASSIGN) {
		const struct parse_symbol *s = parse_node_root(node->children[0]);

		found = s && (!product || names(product, s));
	}
	for (uint32_t i = 0; node && !found && i < node->n; i++)
		found = writes(node->children[i], product);
	return found;
}

/* True if a variable is a factor of a product of matrices, or multiplied by a vector. */
static bool is_factor(const struct parse_node *node, const struct parse_symbol *s)
{
	bool found = false;

	for (uint32_t i = 0; node && i < node->n && i < 2; i++)
		found |= (node->operation == GLSL_MATRIX_TIMES_MATRIX ||
		          (node->operation == GLSL_MATRIX_TIMES_VECTOR && i == 0)) &&
		         node->children[i]->operation == GLSL_SYMBOL && node->children[i]->symbol == s;
	for (uint32_t i = 0; node && !found && i < node->n; i++)
		found = is_factor(node->children[i], s);
	return found;
}

static bool is_used_straight(const struct parse_nodes *statements, uint32_t next, const struct parse_symbol *s,
                             const struct parse_node *product)
{
	if (!is_straight(product) || writes(product, NULL))
		return false;
	for (uint32_t end = next + MOST_STATEMENTS; next < end && next < statements->n; next++) {
		const struct parse_node *statement = statements->at[next];

		if (!is_straight(statement) || writes(statement, product))
			return false;
		if (names(statement, s))
			return is_factor(statement, s);
	}
	return false;
}

/* Flatten nested sequences into one list of statements. */
static void list(struct parse *p, const struct parse_node *sequence, struct parse_nodes *statements)
{
	for (uint32_t i = 0; i < sequence->n; i++)
		if (sequence->children[i]->operation == GLSL_SEQUENCE)
			list(p, sequence->children[i], statements);
		else
			parse_nodes_add(p, statements, sequence->children[i]);
}

static void find(struct parse *p, const struct parse_node *node)
{
	struct parse_nodes statements = { 0 };

	if (!node)
		return;
	if (node->operation != GLSL_SEQUENCE) {
		for (uint32_t i = 0; i < node->n; i++)
			find(p, node->children[i]);
		return;
	}
	list(p, node, &statements);
	for (uint32_t i = 0; i < statements.n; i++) {
		const struct parse_node *set = statements.at[i];
		const bool is_set = set->operation == GLSL_ASSIGN && set->value == GLSL_ASSIGN &&
		                    set->children[0]->operation == GLSL_SYMBOL;
		struct parse_symbol *s = is_set ? set->children[0]->symbol : NULL;

		if (s && set->children[1]->operation == GLSL_MATRIX_TIMES_MATRIX && s->storage == GLSL_LOCAL &&
		    s->named == 2 && is_used_straight(&statements, i + 1, s, set->children[1]))
			s->product = set->children[1];
		find(p, set);
	}
}

void parse_find_products(struct parse *p)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < p->root->n; i++) {
		const struct parse_node *node = p->root->at[i];

		count(p, node->operation == GLSL_CALL ? node->function->body : node, &n);
	}
	for (uint32_t i = 0; i < p->root->n; i++)
		if (p->root->at[i]->operation == GLSL_CALL)
			find(p, p->root->at[i]->function->body);
}
