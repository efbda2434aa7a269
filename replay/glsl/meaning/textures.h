/* Functions that sample textures (GLSL 1.20 sec. 8.7, GLSL 1.50 sec. 8.7): decoded from their names. */
#pragma once

#include "replay/glsl/meaning/nodes.h"

/** True if the language has such a function of this name in the current version. */
bool parse_is_texture_call(const struct parse *p, const char *name);

/** A call. @return NULL: the function does not take these arguments */
struct parse_node *parse_texture_call(struct parse *p, const char *name, const struct parse_nodes *arguments);
