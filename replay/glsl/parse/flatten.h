/* Converts nodes with pointers to the tree that the translator reads. */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** Fill in an all-zero tree from p->root. The tree owns its arrays. */
void parse_flatten(struct parse *p, struct glsl_tree *tree);
