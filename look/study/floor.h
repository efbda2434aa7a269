/*
 * Floors that are smooth and dark, as polished stone is: they mirror what stands on them. Where OpenGL lights a floor,
 * its specular colour says how it mirrors (look/gloss.h). Where it does not, shadows flattened onto the floor say that
 * things stand on it, and its texture says that it has no grain: grass, cloth and sand have some.
 */
#pragma once

#include "look/findings.h"
#include "look/study/tricks.h"

enum { FLOORS_MOST = 32 }; /* textures */

struct floor_texture {
	uint64_t hash[2];
	double share;       /* of the window, summed over frames */
	double even, shown; /* shares of texels that are as their neighbours, and the mean of their largest channel */
	unsigned draws, shadowed; /* of these, such as lie in the plane of a shadow */
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
