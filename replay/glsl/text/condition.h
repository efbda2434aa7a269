/* Evaluation of the integer expressions of #if and #elif (GLSL 1.50 sec. 3.3). */
#pragma once

#include "replay/glsl/text/context.h"

/** The value of a directive's line after its first word. Names that are not macros are 0. */
int32_t parse_condition(struct parse *p, const struct parse_token *tokens, uint32_t n);
