/* Declarations of variables and blocks (GLSL 1.50 sec. 4). */
#pragma once

#include "replay/glsl/parse/qualifiers.h"

/** Variables behind their type, up to ';'. @param list  receives what gives them their values. first: the first one's
 * name */
void parse_variables(struct parse *p, const struct parse_qualifiers *q, const struct parse_type *type,
                     struct parse_name *first, struct parse_nodes *list);

/** A declaration in a function. */
void parse_local_declaration(struct parse *p, struct parse_nodes *list);

/** A block behind its qualifiers. */
void parse_block(struct parse *p, const struct parse_qualifiers *q);

/** A variable without a list: that of a condition. @return what gives it its value */
struct parse_node *parse_condition_variable(struct parse *p);

/** precision ...; */
void parse_precision(struct parse *p);
