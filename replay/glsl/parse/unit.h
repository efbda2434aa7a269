/* A shader object's text, from its first line to its last (GLSL 1.50 sec. 9, translation_unit). */
#pragma once

#include "replay/glsl/text/context.h"

/** Read a text. What it defines goes to the stage: functions, p->root. */
void parse_unit(struct parse *p, const char *text);
