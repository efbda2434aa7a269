/*
 * Two frames while a scene between them is made: which draws show the same thing and how each moves (couples.c), and
 * whether a cut separates them (cut.c). One of the two frames is the base of that scene.
 */
#pragma once

#include "scene/scene.h"

#define BRIDGE_SAME 1e-4 /* two motions are equal if they take every corner to the same point, up to this share of
                            its distance */

/* A draw of the base and the draw of the other frame that shows the same thing. */
struct couple {
	uint32_t other;      /* instance; SCENE_NONE: there is none */
	int is_sure;         /* 1: no other draw is a candidate */
	int moves;           /* 1: `motion` is known */
	double motion[16];   /* eye space, from the first frame to the second */
	double corner[8][4]; /* the mesh's box, eye space of the first frame */
	double size;         /* diagonal of that box */
};

#define BRIDGE_MOTIONS 64u /* at most; further ones are ignored */

/* A motion shared by draws, and its inverse. */
struct motion {
	double motion[16], back[16];
	double weight;  /* the sum of their sizes */
	uint32_t space; /* eye space of their views */
};

struct bridge {
	const struct scene *base, *other; /* the base of the scene; the other frame */
	int is_back;                 /* 1: the base is the second in time */
	struct couple *couples;      /* [instances] */
	float (*boxes)[2][3];        /* [meshes] of the base, object space */
	struct motion *motions;      /* [n_motions], by descending weight */
	unsigned n_motions;
	const struct motion *camera; /* the scene's motion due to the camera, one of `motions`; NULL: unknown */
	uint32_t n_matched, n_alone; /* draws with a partner and without; pixel rectangles are not counted */
};

void bridge_end(struct bridge *b);

/** The modelview of a couple in the first frame (second 0) or in the second (1). */
const float *bridge_place(const struct bridge *b, uint32_t i, int second);

/** A corner of the box around an instance's mesh, in object space. Bit c of k is 1 for the upper end along axis c. */
void bridge_corner(const struct bridge *b, uint32_t i, int k, double out[4]);

/** 1 if two draws, one of each frame, may show the same thing. */
int bridge_may_be_one(const struct bridge *b, uint32_t i, uint32_t other);

/** Find the motion of a couple whose `other` is set. */
void bridge_find_motion(struct bridge *b, uint32_t i);

/** 1 if two motions are equal for a draw. */
int bridge_agrees(const struct couple *c, const double a[16], const double b[16]);

/** 1 if a draw moves as the known motion of the camera predicts. */
int bridge_is_filmed(const struct bridge *b, uint32_t i);

/** A motion from the base to the other frame. */
const double *bridge_way(const struct bridge *b, const struct motion *m);

/** 1 for a cut: less than half of the depth-tested surface in the base is in the other frame, at most half a picture
 * away. */
int bridge_is_cut(const struct bridge *b);
