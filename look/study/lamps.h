/*
 * Lamps: small solid things that nothing lights, with bright and coloured texels, as bulbs, flames and windows at night
 * were drawn. They are their own light; in a world that OpenGL does not light they light what is about them.
 */
#pragma once

#include "look/findings.h"
#include "look/study/kinds.h"
#include "look/study/motion.h"
#include "scene/scene.h"

enum { LAMPS_MOST = 6, LAMPS_SEEN = 64 };

/* All zero: nothing was seen. */
struct lamps {
	struct lamp_seen {
		uint64_t texture[2];
		double color[3]; /* mean of its bright texels, [0,1]; 0: it has too few */
	} textures[LAMPS_SEEN];
	unsigned n_textures;
	struct lamp {
		uint32_t thing;  /* of motion.things */
		uint32_t draws;  /* that show it as a lamp */
		double color[3], at[3], size; /* in the world, as it was last seen; half its box's diagonal */
		uint64_t mesh[2];
	} list[LAMPS_SEEN];
	unsigned n;
};

/** Study one more frame, after motion_add. layers: which instances are of a sky (layer.h) */
void lamps_add(struct lamps *l, const struct scene *scene, const struct motion *motion, const uint8_t *layers);

/** How many there are that stand still. */
unsigned lamps_count(const struct lamps *l, const struct motion *motion);

/** Rules for surfaces: lamps stay as bright as they are. */
void lamps_find_surfaces(const struct lamps *l, const struct motion *motion, struct findings *out);

/** Rules for the lights of the largest lamps. */
void lamps_find_lights(const struct lamps *l, const struct motion *motion, struct findings *out);
