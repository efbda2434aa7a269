/*
 * Smooth, dark floors, such as polished stone, which mirror what is on them. If OpenGL lights a floor, its specular
 * colour gives its reflectance (look/draws/gloss.h). If not, shadows flattened onto it prove that things rest on it,
 * and its texture must have no grain, unlike grass, cloth and sand.
 */
#pragma once

#include "look/rules/findings.h"
#include "look/study/tricks/tricks.h"

enum { FLOORS_MOST = 32 }; /* textures */

struct floor_texture {
	uint64_t hash[2];
	double share;       /* sum over frames of the share of the window */
	double even, shown; /* share of texels that resemble their neighbours; mean of the largest channel */
	unsigned draws, shadowed; /* shadowed: draws that lie in the plane of a shadow */
};

/* All zero: empty. */
struct floors {
	struct floor_texture textures[FLOORS_MOST];
	unsigned n, frames;
};

/** Study one more frame, after shadows_add. */
void floors_add(struct floors *f, const struct scene *scene, const struct motion *motion, const struct tricks *tricks);

/** Rules for surfaces. */
void floors_find(const struct floors *f, struct findings *out);
