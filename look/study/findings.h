/* What a study found, of lights, as rules (look/rules.h). */
#pragma once

#include <stdio.h>

#include "look/study/lightmaps.h"
#include "look/study/solve.h"
#include "look/study/tricks.h"

/** 1 where the lights explain the lightmaps so well that walls may be lit anew. */
int findings_relights(const struct solved *solved);

/** Entries of the list `surfaces`. */
void findings_write_surfaces(const struct tricks *tricks, const struct lightmaps *maps, const struct solved *solved,
                             FILE *out);

/** The list `lights`, its last entries left to who knows more. has_more: 1: there are such */
void findings_write_lights(const struct tricks *tricks, const struct lightmaps *maps, const struct solved *solved,
                           int has_more, FILE *out);
