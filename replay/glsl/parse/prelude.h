/* Names that the language declares itself (GLSL 1.50 sec. 7), in its own words. */
#pragma once

#include "replay/glsl/text/context.h"

extern const unsigned parse_prelude_parts;

/** A part of the declarations. @return NULL: the stage or the version does not have it */
const char *parse_prelude(const struct parse *p, unsigned part);
