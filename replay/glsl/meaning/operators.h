/* Operators: the types of their operands and results (GLSL 1.20 sec. 5). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** A binary operator other than assignment. */
struct parse_node *parse_operate(struct parse *p, uint32_t sign, struct parse_node *a, struct parse_node *b);

/** Unary + - ! ~. */
struct parse_node *parse_operate_before(struct parse *p, uint32_t sign, struct parse_node *a);

/** Prefix and postfix ++ and --. */
struct parse_node *parse_increment(struct parse *p, enum glsl_operator operation, struct parse_node *a);

/** = and compound assignments; sign: the operator without '=', 0: none. */
struct parse_node *parse_assign(struct parse *p, uint32_t sign, struct parse_node *to, struct parse_node *value);

/** condition ? a : b */
struct parse_node *parse_choose(struct parse *p, struct parse_node *condition, struct parse_node *a,
                                struct parse_node *b);

/** Report an error unless a node is a bool. */
void parse_need_bool(struct parse *p, const struct parse_node *node);
