/* Functions that the language has (GLSL 1.50 sec. 8), but for those that sample textures. */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** Whether the language has a function of this name here. */
bool parse_is_builtin(const struct parse *p, const char *name);

/** A call. @return NULL: none of the name takes these arguments */
struct parse_node *parse_builtin_call(struct parse *p, const char *name, const struct parse_nodes *arguments);
