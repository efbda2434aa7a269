/*
 * Variables that stand for a product of matrices without effects: set once, and named once more, as a factor, in a
 * statement that follows straight, with nothing of the product changed by then. Mesa (22.3.6) puts the product there,
 * and does it from a vector on.
 */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** Set symbol.product of all of them in p->root. Ends where that holds more nodes than are done. */
void parse_find_products(struct parse *p);
