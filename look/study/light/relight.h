/* Rules that replace light drawn by the program itself: shadows, mirrors, lightmaps and vertex colours. */
#pragma once

#include "look/rules/findings.h"
#include "look/study/light/lightmaps.h"
#include "look/study/light/solve.h"
#include "look/study/tricks/tricks.h"

/** 1 if the lights explain the lightmaps well enough to light walls in their place. */
int relight_is_known(const struct solved *solved);

/** Rules for surfaces. */
void relight_find_surfaces(const struct tricks *tricks, const struct lightmaps *maps, const struct solved *solved,
                           struct findings *out);

/** Rules for lights. */
void relight_find_lights(const struct tricks *tricks, const struct lightmaps *maps, const struct solved *solved,
                         struct findings *out);
