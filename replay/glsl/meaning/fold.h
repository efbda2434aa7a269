/*
 * Values of operators that are known when the text is read. Floats are rounded to 32 bits at each step, as Mesa does
 * it; whole numbers wrap.
 */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** A number as its kind keeps it. */
double parse_fold_rounded(enum glsl_kind kind, double value);

struct parse_node *parse_fold_convert(struct parse *p, const struct parse_node *node, const struct parse_type *to);

/* Operators whose nodes are GLSL_OTHER, as their values are not done. */
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
 * Of one or two constants. `bits` counts where the operation is GLSL_OTHER.
 * @param type  of the value
 * @param b     NULL: there is one operand
 */
struct parse_node *parse_fold(struct parse *p, enum glsl_operator operation, enum parse_bits bits,
                              const struct parse_type *type, const struct parse_node *a, const struct parse_node *b);

/** A value made of others' numbers (GLSL 1.20 sec. 5.4). values: of the value's kind, unless it is an array or a
 * structure */
struct parse_node *parse_fold_construct(struct parse *p, const struct parse_type *type,
                                        const struct parse_nodes *values);
