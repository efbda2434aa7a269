/*
 * Two frames, matched draw by draw so that scenes between them can be made: which draws show the same thing, and how
 * each of them moves (couples.c); whether a cut separates the frames (cut.c). A scene between them starts as a copy of
 * one, its base. Motions lead from the first frame in time to the second, whichever is the base.
 */
#pragma once

#include "scene/scene.h"

/* Tolerance of equal motions and places, as a share of the largest number compared. */
#define BRIDGE_SAME 1e-4

/* A draw of the base, and the draw of the other frame that shows the same thing. */
struct couple {
	uint32_t other;      /* instance of the other frame; SCENE_NONE: there is none */
	int is_sure;         /* 1: no other draw is a candidate */
	int moves;           /* 1: `motion` is known, and pose.h can interpolate it */
	double motion[16];   /* from eye space of the first frame to that of the second */
	double corner[8][4]; /* corners of the mesh's box, eye space of the first frame; order as in bridge_corner */
	double size;         /* diagonal of that box */
};

#define BRIDGE_MOTIONS 64u /* motions that a bridge keeps; further ones are ignored */

/* A motion that several draws share. */
struct motion {
	double motion[16], back[16]; /* as in struct couple; its inverse */
	double weight;  /* sum of the sizes of these draws */
	uint32_t space; /* scene_view.space of their views */
};

struct bridge {
	const struct scene *base, *other; /* the two frames; borrowed */
	int is_back;                 /* 1: the base is the second in time */
	struct couple *couples;      /* [instances of the base] */
	float (*boxes)[2][3];        /* [meshes] of the base, object space */
	struct motion *motions;      /* [n_motions], by descending weight */
	unsigned n_motions;
	const struct motion *camera; /* one of `motions`: that of static things, due to the camera; NULL: unknown */
	uint32_t n_matched, n_alone; /* draws with a partner and without; pixel rectangles are not counted */
};

/** Free the arrays that couples_find (couples.h) allocated. */
void bridge_end(struct bridge *b);

/* In the following, i is an instance of the base. */

/** The modelview of a draw that has a partner: in the first frame if second is 0, in the second if it is 1. */
const float *bridge_place(const struct bridge *b, uint32_t i, int second);

/** Corner k (0 to 7) of the box around a draw's mesh, object space. Bit c of k is 1 for the upper end along axis c. */
void bridge_corner(const struct bridge *b, uint32_t i, int k, double out[4]);

/**
 * 1 if a draw of the base and one of the other frame may show the same thing: they have the same target, and the same
 * points or, if they are depth-tested, meshes that can be mixed (mixed_suits).
 */
int bridge_may_be_one(const struct bridge *b, uint32_t i, uint32_t other);

/** Fill in motion, corners and size of a couple whose `other` is set. */
void bridge_find_motion(struct bridge *b, uint32_t i);

/** 1 if two motions take every corner of a draw's box to the same place, up to BRIDGE_SAME. */
int bridge_agrees(const struct couple *c, const double a[16], const double b[16]);

/**
 * 1 if the camera's motion is known and applies to a draw's view: the window in perspective, in the camera's eye space.
 * The draw itself may move as well.
 */
int bridge_is_filmed(const struct bridge *b, uint32_t i);

/** A motion as it leads from the base to the other frame: m->motion or m->back. */
const double *bridge_way(const struct bridge *b, const struct motion *m);

/**
 * 1 for a cut: of the depth-tested surface that the base shows, less than half appears in the other frame within half a
 * picture of its old place.
 */
int bridge_is_cut(const struct bridge *b);
