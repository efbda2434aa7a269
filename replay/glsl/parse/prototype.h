/* Function prototypes (GLSL 1.20 sec. 6.1). */
#pragma once

#include "replay/glsl/meaning/functions.h"
#include "replay/glsl/parse/qualifiers.h"

/** Parse a function's parameters, after its name and '(' and up to ')', and declare it. */
struct parse_function *parse_prototype(struct parse *p, const struct parse_qualifiers *q,
                                       const struct parse_type *result, struct parse_name *name);
