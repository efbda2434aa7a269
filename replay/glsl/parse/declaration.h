/* Declarations of variables and blocks (GLSL 1.50 sec. 4). */
#pragma once

#include "replay/glsl/parse/qualifiers.h"

/**
 * Parse variables after their type, up to ';'. @param list  receives the nodes that initialize them. first: name of the
 * first one
 */
void parse_variables(struct parse *p, const struct parse_qualifiers *q, const struct parse_type *type,
                     struct parse_name *first, struct parse_nodes *list);

/** Parse a declaration in a function. */
void parse_local_declaration(struct parse *p, struct parse_nodes *list);

/** Parse a block after its qualifiers. */
void parse_block(struct parse *p, const struct parse_qualifiers *q);

/** Parse the single variable of a condition. @return the node that initializes it */
struct parse_node *parse_condition_variable(struct parse *p);

/** Parse precision ...; */
void parse_precision(struct parse *p);
