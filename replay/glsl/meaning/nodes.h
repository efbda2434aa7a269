/* The parsed program before it becomes a tree (tree.h): nodes with pointers, whose operations are the tree's. */
#pragma once

#include "replay/glsl/meaning/types.h"

struct parse_node {
	enum glsl_operator operation;
	uint32_t value, n, depth;      /* value: as in struct glsl_node; depth: 1: no children */
	const struct parse_type *type; /* not of a symbol: use parse_node_type */
	struct parse_node **children;  /* [n]; NULL for an omitted one */
	union {
		struct parse_symbol *symbol;     /* for GLSL_SYMBOL */
		struct parse_function *function; /* for GLSL_CALL */
		const double *numbers;           /* for GLSL_NUMBERS: [type->numbers] */
	};
};

struct parse_symbol {
	struct parse_name *name;
	const struct parse_type *type;
	enum glsl_storage storage;
	const double *numbers;      /* initial or constant value; NULL: none */
	uint32_t location, binding; /* GLSL_NONE: not given in the text */
	uint32_t declared, length;  /* length: of an array declared without one, as its indices require so far */
	bool flat, straight, is_fixed, is_built_in, is_block; /* is_fixed: must not be assigned */
	bool is_assigned;                                     /* some statement assigns it */
	uint32_t number;                                      /* 1 + index in the tree; 0: not in the tree yet */
	uint32_t named;                                       /* products.c: number of uses */
	struct parse_node *product;                           /* products.c: the node that replaces it */
};

/* A list of nodes. */
struct parse_nodes {
	struct parse_node **at;
	uint32_t n, room;
};
void parse_nodes_add(struct parse *p, struct parse_nodes *list, struct parse_node *node);

/** A node with n children, at most 3. */
struct parse_node *parse_node(struct parse *p, enum glsl_operator operation, const struct parse_type *type, uint32_t n,
                              ...);
struct parse_node *parse_node_of(struct parse *p, enum glsl_operator operation, const struct parse_type *type,
                                 const struct parse_nodes *children);
struct parse_node *parse_node_symbol(struct parse *p, struct parse_symbol *symbol);
/** numbers: not copied, must stay valid */
struct parse_node *parse_node_numbers(struct parse *p, const struct parse_type *type, const double *numbers);
struct parse_node *parse_node_number(struct parse *p, enum glsl_kind kind, double value);

/** True if a node's value is known. */
static inline bool parse_is_constant(const struct parse_node *node)
{
	return node->operation == GLSL_NUMBERS;
}
/** True if all nodes are constant. */
bool parse_are_constant(const struct parse_nodes *list);

/** The symbol that a node is the whole or a part of; NULL: none. */
struct parse_symbol *parse_node_root(const struct parse_node *node);
