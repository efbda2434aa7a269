/* From nodes with pointers to the tree that the translation reads. */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** Fill a tree that is all zero with what the stage has: p->root. It owns its arrays. */
void parse_flatten(struct parse *p, struct glsl_tree *tree);
