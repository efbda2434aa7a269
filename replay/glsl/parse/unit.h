/* Parser for the text of a shader object (GLSL 1.50 sec. 9, translation_unit). */
#pragma once

#include "replay/glsl/text/context.h"

/** Parse a text. Its definitions are added to the stage: functions, p->root. */
void parse_unit(struct parse *p, const char *text);
