/*
 * Two frames while the scene between them is made: which draws are one, and how each moves (couples.c); whether a cut
 * separates them (cut.c).
 */
#pragma once

#include "look/between/mixed.h"

#define BRIDGE_SAME 1e-4 /* two motions are one where they take no corner farther apart, of its distance */

/* A draw of the nearer frame and the draw of the farther one that shows the same thing. */
struct couple {
	uint32_t other;      /* instance; SCENE_NONE: there is none */
	int moves;           /* 1: `motion` is known */
	double motion[16];   /* eye space, from the first frame to the second */
	double corner[8][4]; /* the mesh's box, eye space of the first frame */
	double size;         /* diagonal of that box */
};

struct bridge {
	struct mixer mixer;
	struct couple *couples; /* [instances] */
	double (*boxes)[2][3];  /* [meshes] of the nearer frame, object space */
	uint32_t *views;        /* [views] of the nearer frame: the mixed view, or SCENE_NONE */
	double camera[16], back[16]; /* motion of the scene by the camera, and its inverse */
	uint32_t space;         /* eye space of that camera; SCENE_NONE: it is not known */
};

/** Find couples, their motions and the camera's. Arrays are there. @return 0 or ERR_SYSTEM (reported) */
int bridge_couple(struct bridge *b);

/** Modelview of a couple in one of its frames. */
const float *bridge_place(const struct bridge *b, uint32_t i, const struct scene *frame);

/** 1 if two motions are the same to a draw. */
int bridge_agrees(const struct couple *c, const double a[16], const double b[16]);

/** 1 if the camera that is known shows a draw. */
int bridge_is_filmed(const struct bridge *b, uint32_t i);

/** 1 if less than half of the depth-tested surface that the nearer frame shows is in view in the farther one. */
int bridge_is_cut(const struct bridge *b);
