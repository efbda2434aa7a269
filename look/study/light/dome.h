/*
 * Light from all around for recordings without other light, and how far things dim it. It is derived from the share
 * of solid surfaces that OpenGL lights, the visible size of the world, and the direction that is up.
 */
#pragma once

#include "look/rules/findings.h"
#include "look/study/motion/motion.h"
#include "scene/scene.h"

enum { DOME_SIZES = 160, DOME_UPS = 48 };

/* All zero: empty. Weights are shares of the window. */
struct dome {
	double lit, unlit;
	double sizes[2][DOME_SIZES]; /* [0] unlit, [1] lit: weight by half the window's width at that depth, eye
	                                units, four to an octave */
	struct dome_up {
		double normal[3], weight; /* in the world; normals of floors, and reversed ones of ceilings */
	} ups[DOME_UPS];
	unsigned n_ups;
	double all;          /* total weight of all normals */
	double up_eye[3];    /* the window's up, in the last frame */
	double sky[3];       /* sum of the sky pictures' colours */
	unsigned skies;      /* number of these pictures */
	unsigned frames, known; /* known: frames with a known camera */
};

/**
 * Study one more frame, after motion_add.
 * @param layers  which instances belong to a sky (layer.h)
 */
void dome_add(struct dome *d, const struct scene *scene, const struct motion *motion, const uint8_t *layers);

/** 1 if nearly all solid surfaces are unlit. */
int dome_is_wanted(const struct dome *d);

/** Find the world's up direction from its floors. @return 0: there are too few */
int dome_find_up(const struct dome *d, double up[3]);

/** The rule `sky`: for all surfaces or, in a world that OpenGL lights, for those that it lights. */
void dome_find(const struct dome *d, struct findings *out);
