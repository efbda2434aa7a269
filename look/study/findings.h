/* What a study found, as rules: the lists `surfaces` and `lights` (look/rules.h). */
#pragma once

#include <stdio.h>

#include "look/study/tricks.h"

void findings_write(const struct tricks *tricks, FILE *out);
