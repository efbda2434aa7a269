/*
 * A sun that a sky shows: a small round spot of white texels in a picture that is darker all about, at one place of the
 * world in all frames. It lights a world that nothing else lights, where most of what is in sight is open to it.
 */
#pragma once

#include <stdint.h>

#include "look/findings.h"
#include "look/study/motion.h"
#include "scene/scene.h"

enum { SUN_PICTURES = 64 };

/* All zero: nothing was seen. */
struct sun {
	struct sun_picture {
		uint64_t hash[2]; /* of a texture, */
		double at[2];     /* and where its spot is, in [0,1] */
		int has_spot;
	} pictures[SUN_PICTURES];
	unsigned n_pictures;
	double towards[3]; /* sum of unit vectors, in the world */
	unsigned skies, frames; /* frames with a sky; of these, with a spot */
	unsigned open, places;  /* places in sight: those that the spot can light, of all */
};

/**
 * Study one more frame, after motion_add.
 * @param layers  which instances are of a sky (layer.h)
 * @return 0 or ERR_SYSTEM (reported)
 */
int sun_add(struct sun *sun, const struct scene *scene, const struct motion *motion, const uint8_t *layers);

/** Whether there is one. towards: receives the unit vector, in the world */
int sun_is_there(const struct sun *sun, double towards[3]);

/** The rule for surfaces that the sun or lamps light. */
void sun_find_surfaces(struct findings *out);

/** The rule for the sun's light. @param up  the world's up; level ground keeps its brightness */
void sun_find_light(const struct sun *sun, const double up[3], struct findings *out);

/** The rule for the ambient light beside the sun or lamps. @param up  as above; NULL: there are lamps, but no sun */
void sun_find_ambient(const struct sun *sun, const double *up, struct findings *out);
