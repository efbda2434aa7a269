/* What a study found, as rules: the lists `surfaces` and `lights` (look/rules.h). */
#pragma once

#include <stdio.h>

#include "look/study/lightmaps.h"
#include "look/study/solve.h"
#include "look/study/tricks.h"

/** 1 where the lights explain the lightmaps so well that walls may be lit anew. */
int findings_relights(const struct solved *solved);

void findings_write(const struct tricks *tricks, const struct lightmaps *maps, const struct solved *solved, FILE *out);
