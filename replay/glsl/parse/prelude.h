/* Built-in names (GLSL 1.50 sec. 7), declared in GLSL itself. */
#pragma once

#include "replay/glsl/text/context.h"

extern const unsigned parse_prelude_parts;

/** A part of the declarations. @return NULL: not available in this stage or version */
const char *parse_prelude(const struct parse *p, unsigned part);
