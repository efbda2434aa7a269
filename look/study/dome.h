/*
 * Light from all around, for a recording that has no other, and where things dim it: how much of what is solid OpenGL
 * lights, how large the world is as it is seen, and which way is up.
 */
#pragma once

#include "look/findings.h"
#include "look/study/motion.h"
#include "scene/scene.h"

enum { DOME_SIZES = 160, DOME_UPS = 48 };

/* All zero: nothing was seen. Weights are shares of the window. */
struct dome {
	double lit, unlit;
	double sizes[2][DOME_SIZES]; /* of what is unlit, and of what is lit, by half the window's width where it
	                                stands, eye units: four to an octave */
	struct dome_up {
		double normal[3], weight; /* in the world; floors' normals, and ceilings' turned */
	} ups[DOME_UPS];
	unsigned n_ups;
	double all;          /* weight of all normals */
	double up_eye[3];    /* the window's, of the last frame */
	double sky[3];       /* sum of its pictures' colours, */
	unsigned skies;      /* so many */
	unsigned frames, known; /* of these, with a known camera */
};

/**
 * Study one more frame, after motion_add.
 * @param layers  which instances are of a sky (layer.h)
 */
void dome_add(struct dome *d, const struct scene *scene, const struct motion *motion, const uint8_t *layers);

/** Whether nearly all that is solid is lit by nothing. */
int dome_is_wanted(const struct dome *d);

/** The world's up, by its floors. @return 0: they do not tell */
int dome_find_up(const struct dome *d, double up[3]);

/** The rule `sky`: for all surfaces or, in a world that OpenGL lights, for those that it lights. */
void dome_find(const struct dome *d, struct findings *out);
