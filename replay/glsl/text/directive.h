/* Lines that begin with '#': what of a unit is read, and as which language (GLSL 1.50 sec. 3.3). */
#pragma once

#include "replay/glsl/text/context.h"

/** Begin a unit: the text's version is known from here on, nothing is defined but what the language defines. */
void parse_directive_begin(struct parse *p, const char *text);

/** The next token of the text that the directives leave, macros not expanded: parse.read */
void parse_directive_read(struct parse *p, struct parse_token *token);
