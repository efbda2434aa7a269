/*
 * Finds variables that hold a product of matrices, without side effects: assigned once, and used once, as a factor, in
 * straight-line code that follows, with no operand of the product changed in between. Mesa (22.3.6) substitutes the
 * product, and then multiplies starting from the vector.
 */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** Set symbol.product for all of these in p->root. Reports an error if that has too many nodes. */
void parse_find_products(struct parse *p);
