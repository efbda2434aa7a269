/* Statements (GLSL 1.50 sec. 6). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** Behind '{', up to '}', in the scope that there is. @return a GLSL_SEQUENCE */
struct parse_node *parse_statements(struct parse *p);
