/* User-defined functions: declarations, and overload resolution of calls (GLSL 1.20 sec. 6.1). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

struct parse_function {
	struct parse_function *next, *next_of_stage,
	        *before; /* before: declared before this one, under any name */
	struct parse_name *name;
	const struct parse_type *result;
	uint32_t n, unit;                 /* number of parameters; unit: the last unit that declared it */
	struct parse_symbol **parameters; /* those of its definition, or of its first declaration */
	struct parse_node *body;          /* NULL: not defined */
	struct parse_function **calls;    /* functions that it calls, possibly with duplicates */
	uint32_t n_calls, call_room;
	bool is_checked, is_open; /* for detecting recursion; is_open: the search is inside it */
	uint32_t number;          /* 1 + index in the tree; 0: not in the tree yet */
};

/** Declare a function, possibly again. defines: its body follows */
struct parse_function *parse_declare_function(struct parse *p, struct parse_name *name, const struct parse_type *result,
                                              struct parse_symbol **parameters, uint32_t n, bool defines);

/** A call of a user-defined or built-in function. */
struct parse_node *parse_call(struct parse *p, struct parse_name *name, const struct parse_nodes *arguments);

/** Report an error if a function calls itself, directly or indirectly. */
void parse_check_calls(struct parse *p);
