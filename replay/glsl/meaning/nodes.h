/* What a text means, before it becomes a tree (tree.h): nodes with pointers, whose operations are the tree's. */
#pragma once

#include "replay/glsl/meaning/types.h"

struct parse_node {
	enum glsl_operator operation;
	uint32_t value, n, depth;      /* value: as of struct glsl_node; depth: 1: it has no children */
	const struct parse_type *type; /* of a symbol: parse_node_type has it */
	struct parse_node **children;  /* [n]; NULL where one is not there */
	union {
		struct parse_symbol *symbol;     /* of GLSL_SYMBOL */
		struct parse_function *function; /* of GLSL_CALL */
		const double *numbers;           /* of GLSL_NUMBERS: [type->numbers] */
	};
};

struct parse_symbol {
	struct parse_name *name;
	const struct parse_type *type;
	enum glsl_storage storage;
	const double *numbers;      /* that it begins with, or always has; NULL: none */
	uint32_t location, binding; /* GLSL_NONE: the text does not say */
	uint32_t declared, length;  /* length: of an array without one, as far as it is indexed */
	bool flat, straight, is_fixed, is_built_in, is_block; /* is_fixed: nothing may assign it */
	bool is_assigned;                                     /* something does */
	uint32_t number;                                      /* 1 + that in the tree; 0: none yet */
	uint32_t named;                                       /* products.c: how often */
	struct parse_node *product;                           /* products.c: what goes in its place */
};

/* A list of nodes. */
struct parse_nodes {
	struct parse_node **at;
	uint32_t n, room;
};
void parse_nodes_add(struct parse *p, struct parse_nodes *list, struct parse_node *node);

/** A node of n children, at most 3. */
struct parse_node *parse_node(struct parse *p, enum glsl_operator operation, const struct parse_type *type, uint32_t n,
                              ...);
struct parse_node *parse_node_of(struct parse *p, enum glsl_operator operation, const struct parse_type *type,
                                 const struct parse_nodes *children);
struct parse_node *parse_node_symbol(struct parse *p, struct parse_symbol *symbol);
/** numbers: kept */
struct parse_node *parse_node_numbers(struct parse *p, const struct parse_type *type, const double *numbers);
struct parse_node *parse_node_number(struct parse *p, enum glsl_kind kind, double value);

/** Whether a node's value is known. */
static inline bool parse_is_constant(const struct parse_node *node)
{
	return node->operation == GLSL_NUMBERS;
}
/** Whether all are. */
bool parse_are_constant(const struct parse_nodes *list);

/** The symbol of which a node is the whole or a part; NULL: it is none's. */
struct parse_symbol *parse_node_root(const struct parse_node *node);
