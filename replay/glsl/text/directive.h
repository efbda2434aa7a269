/*
 * Preprocessor directives: they select the parts of a unit that are read, and the language version (GLSL 1.50 sec.
 * 3.3).
 */
#pragma once

#include "replay/glsl/text/context.h"

/** Begin a unit: sets its version, and leaves only the predefined macros. */
void parse_directive_begin(struct parse *p, const char *text);

/** The next token that the directives leave, without macro expansion: used as parse.read */
void parse_directive_read(struct parse *p, struct parse_token *token);
