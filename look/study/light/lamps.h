/*
 * Lamps: small solid things that OpenGL does not light, with bright, coloured texels, as bulbs, flames and lit
 * windows are drawn. They keep their brightness; in a world that OpenGL does not light, they light their
 * surroundings.
 */
#pragma once

#include "look/rules/findings.h"
#include "look/study/motion/motion.h"
#include "look/study/roles/kinds.h"
#include "scene/scene.h"

enum { LAMPS_MOST = 6, LAMPS_SEEN = 64 };

/* All zero: empty. */
struct lamps {
	struct lamp_seen {
		uint64_t texture[2];
		double color[3]; /* mean of its bright texels, [0,1]; 0: too few of them */
	} textures[LAMPS_SEEN];
	unsigned n_textures;
	struct lamp {
		uint32_t thing;  /* index in motion.things */
		uint32_t draws;  /* draws that show it as a lamp */
		double color[3], at[3], size; /* in the world, when it was last seen; size: half its box's diagonal */
		uint64_t mesh[2];
	} list[LAMPS_SEEN];
	unsigned n;
};

/** Study one more frame, after motion_add. @param layers  which instances belong to a sky (layer.h) */
void lamps_add(struct lamps *l, const struct scene *scene, const struct motion *motion, const uint8_t *layers);

/** The number of lamps that stand still. */
unsigned lamps_count(const struct lamps *l, const struct motion *motion);

/** Rules for surfaces: lamps keep their brightness. */
void lamps_find_surfaces(const struct lamps *l, const struct motion *motion, struct findings *out);

/** Rules for the lights of the largest lamps. */
void lamps_find_lights(const struct lamps *l, const struct motion *motion, struct findings *out);
