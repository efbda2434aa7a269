/* Statements (GLSL 1.50 sec. 6). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** Parse statements after '{', up to '}', in the current scope. @return a GLSL_SEQUENCE */
struct parse_node *parse_statements(struct parse *p);
