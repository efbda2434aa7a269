/*
 * Shadows cast as a texture. A unit's coordinates are computed from each point's position, the texture is dark only
 * in its middle, and the object is where that middle falls. Such a unit holds no colour of the ground.
 */
#pragma once

#include "look/rules/findings.h"
#include "scene/scene.h"

enum { CAST_MOST = 16 };

/* All zero: empty. */
struct cast {
	struct cast_texture {
		uint64_t hash[2];
		uint32_t unit, frames, last; /* unit: its number; last: the last frame that showed it, counted from 1 */
		uint32_t thrown, others;     /* lit draws that have it in this unit: shadows, and others */
	} textures[CAST_MOST];
	unsigned n;
	uint32_t frames;
};

/** Study one more frame. */
void cast_add(struct cast *c, const struct scene *scene);

/** Rules for surfaces. */
void cast_find(const struct cast *c, struct findings *out);
