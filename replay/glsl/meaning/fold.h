/* Constant folding of operators. Floats are rounded to 32 bits at each step, as in Mesa; integers wrap. */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** A number as rounded or wrapped to its kind. */
double parse_fold_rounded(enum glsl_kind kind, double value);

struct parse_node *parse_fold_convert(struct parse *p, const struct parse_node *node, const struct parse_type *to);

/* Operators whose nodes are GLSL_OTHER, because they are not translated. */
enum parse_bits {
	PARSE_NO_BITS,
	PARSE_BIT_AND,
	PARSE_BIT_OR,
	PARSE_BIT_XOR,
	PARSE_BIT_NOT,
	PARSE_SHIFT_LEFT,
	PARSE_SHIFT_RIGHT
};

/**
 * Fold an operation on one or two constants. `bits` matters only if the operation is GLSL_OTHER.
 * @param type  of the result
 * @param b     NULL: there is one operand
 */
struct parse_node *parse_fold(struct parse *p, enum glsl_operator operation, enum parse_bits bits,
                              const struct parse_type *type, const struct parse_node *a, const struct parse_node *b);

/**
 * Fold a constructor (GLSL 1.20 sec. 5.4). values: converted to the result's kind, unless that is an array or a
 * structure
 */
struct parse_node *parse_fold_construct(struct parse *p, const struct parse_type *type,
                                        const struct parse_nodes *values);
