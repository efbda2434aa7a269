/*
 * A sun in the sky: a small round spot of white texels in an otherwise darker picture, at the same place of the world
 * in all frames. It lights a world without other lights, if most visible places are open to it.
 */
#pragma once

#include <stdint.h>

#include "look/rules/findings.h"
#include "look/study/motion/motion.h"
#include "scene/scene.h"

enum { SUN_PICTURES = 64 };

/* All zero: empty. */
struct sun {
	struct sun_picture {
		uint64_t hash[2]; /* hash of a texture */
		double at[2];     /* the centre of its spot, in [0,1] */
		int has_spot;
	} pictures[SUN_PICTURES];
	unsigned n_pictures;
	double towards[3]; /* sum of unit vectors, in the world */
	unsigned skies, frames; /* frames with a sky; those with a spot */
	unsigned open, places;  /* visible places that the spot can light; all visible places */
};

/**
 * Study one more frame, after motion_add.
 * @param layers  which instances belong to a sky (layer.h)
 * @return 0 or ERR_SYSTEM (reported)
 */
int sun_add(struct sun *sun, const struct scene *scene, const struct motion *motion, const uint8_t *layers);

/** 1 if there is a sun. @param towards  receives the unit vector, in the world */
int sun_is_there(const struct sun *sun, double towards[3]);

/** The rule for surfaces that the sun or lamps light. */
void sun_find_surfaces(struct findings *out);

/** The rule for the sun's light. @param up  the world's up; level ground keeps its brightness */
void sun_find_light(const struct sun *sun, const double up[3], struct findings *out);

/** The rule for the ambient light beside the sun or lamps. @param up  as above; NULL: there are lamps, but no sun */
void sun_find_ambient(const struct sun *sun, const double *up, struct findings *out);
