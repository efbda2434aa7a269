/*
 * Lights from lightmaps. A texel's light is ambient + sum over lights of color x max(0, cos) x visible / d^2, cut off
 * at 1. Lights are found one by one, each where it explains most of what the others leave; places by search, strengths
 * of all together by non-negative least squares.
 */
#pragma once

#include "look/study/lightmaps.h"

enum { SOLVE_MOST_LIGHTS = 16 };

struct solved {
	struct solved_light {
		double at[3], color[3]; /* in the world; radiant at 1 unit */
		double share;           /* of the light in the lightmaps that it explains, [0,1] */
	} lights[SOLVE_MOST_LIGHTS];
	unsigned n;
	double ambient[3];
	double residual, signal; /* root of mean squares: what is not explained, and what was there */
	size_t texels;           /* that were looked at */
};

/** @return 0 or ERR_SYSTEM (reported). out->n 0: there are no lightmaps, or no light explains them */
int solve_lights(struct lightmaps *maps, struct solved *out);
