/*
 * Lights from lightmaps. The light of a texel is ambient + sum over lights of color x max(0, cos) x visible / d^2,
 * cut off at 1. Lights are added one at a time, each where it explains the most of what the others leave. Positions
 * are found by search, all strengths together by non-negative least squares.
 */
#pragma once

#include "look/study/light/lightmaps.h"

enum { SOLVE_MOST_LIGHTS = 16 };

struct solved {
	struct solved_light {
		double at[3], color[3]; /* in the world; radiant at 1 unit */
		double share;           /* share of the light in the lightmaps that it explains, [0,1] */
	} lights[SOLVE_MOST_LIGHTS];
	unsigned n;
	double ambient[3];
	double residual, signal; /* root mean squares: the unexplained light, and all light */
	size_t texels;           /* number of texels used */
};

/** @return 0 or ERR_SYSTEM (reported). out->n 0: there are no lightmaps, or no light explains them */
int solve_lights(struct lightmaps *maps, struct solved *out);
