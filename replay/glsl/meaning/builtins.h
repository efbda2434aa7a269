/* Built-in functions of the language (GLSL 1.50 sec. 8), except those that sample textures. */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** True if the language has a function of this name in the current version. */
bool parse_is_builtin(const struct parse *p, const char *name);

/** A call. @return NULL: no function of this name takes these arguments */
struct parse_node *parse_builtin_call(struct parse *p, const char *name, const struct parse_nodes *arguments);
