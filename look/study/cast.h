/*
 * A thing's shadow as a texture that is thrown onto the ground: a unit's coordinates are made of each point's place,
 * the texture is dark in its middle alone, and the thing is where that falls. What a unit holds so is no colour of the
 * ground.
 */
#pragma once

#include "look/findings.h"
#include "scene/scene.h"

enum { CAST_MOST = 16 };

/* All zero: nothing was seen. */
struct cast {
	struct cast_texture {
		uint64_t hash[2];
		uint32_t unit, frames, last; /* unit: its number; last: number of the frame that told it last, counted from 1 */
		uint32_t thrown, others;     /* lit draws that have it in this unit */
	} textures[CAST_MOST];
	unsigned n;
	uint32_t frames;
};

/** Study one more frame. */
void cast_add(struct cast *c, const struct scene *scene);

/** Rules for surfaces. */
void cast_find(const struct cast *c, struct findings *out);
