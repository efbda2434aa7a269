/* Functions of the text: what is declared, and which one a call means (GLSL 1.20 sec. 6.1). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

struct parse_function {
	struct parse_function *next, *next_of_stage,
	        *before; /* before: of all names, the one that was declared before it */
	struct parse_name *name;
	const struct parse_type *result;
	uint32_t n, unit;                 /* parameters; unit: the last one that has declared it */
	struct parse_symbol **parameters; /* of its definition, or as it was declared first */
	struct parse_node *body;          /* NULL: it has none */
	struct parse_function **calls;    /* functions that it calls, some of them twice */
	uint32_t n_calls, call_room;
	bool is_checked, is_open; /* for circles of calls; is_open: the search is inside it */
	uint32_t number;          /* 1 + that in the tree; 0: none yet */
};

/** Declare a function, which may be declared already. defines: its body follows */
struct parse_function *parse_declare_function(struct parse *p, struct parse_name *name, const struct parse_type *result,
                                              struct parse_symbol **parameters, uint32_t n, bool defines);

/** A call of the text's functions or of the language's. */
struct parse_node *parse_call(struct parse *p, struct parse_name *name, const struct parse_nodes *arguments);

/** End where a function calls itself, through whichever others. */
void parse_check_calls(struct parse *p);
