/* What a study found, as rules: the lists `surfaces` and `lights` (look/rules.h). */
#pragma once

#include <stdio.h>

#include "look/study/lightmaps.h"
#include "look/study/solve.h"
#include "look/study/tricks.h"

void findings_write(const struct tricks *tricks, const struct lightmaps *maps, const struct solved *solved, FILE *out);
