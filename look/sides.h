/*
 * Sheets block light only on the sides that they show. A program that draws one side of a wall, by culling or by
 * lighting, says nothing of the other: light that comes from there passes. Closed bodies still block, since light
 * meets their outside first.
 */
#pragma once

#include "scene/scene.h"

enum sides_shown {
	SIDES_BOTH,  /* nothing tells them apart */
	SIDES_FRONT, /* the other one is culled */
	SIDES_BACK,
	SIDES_LIT, /* the one that its normals stand on */
};

/* Which sides of its triangles an instance shows. */
struct sides {
	enum sides_shown shown;
	int clockwise; /* 1: corners of shown triangles (SIDES_BOTH: of front ones) run clockwise in object space */
};

struct sides sides_of(const struct scene *scene, const struct scene_instance *in);

/** out: a triangle's cross product in object space, on the side that is shown; all 0 where both are, by its normals */
void sides_towards(const struct scene *scene, const struct scene_instance *in, struct sides sides, uint32_t primitive,
                   double out[3]);

/** 1 where an instance shows the backs of most of its triangles, by area: a body of glass has them outside. */
int sides_back_outside(const struct scene *scene, const struct scene_instance *in);

/* A light, once for all materials that have it. */
struct sides_lamp {
	float position[4]; /* as in scene_light */
	uint32_t space;    /* as in scene_view */
};

/**
 * Find the instances that have a lamp behind them: rays to it have to be asked which side they meet. Closed bodies
 * that show their outside are none: from outside they stop a ray wherever it goes through. (Blended and alpha-tested
 * ones are, as each side that counts takes its share.) What is drawn twice, so that each side is shown, shows both.
 *
 * @param lamps  NULL: light may come from anywhere
 * @param bits   [n_instances]: receives SCENE_ONE_SIDED, and SCENE_SHOWN_* where the winding tells its sides
 * @param n      grows by their number
 * @return 0 or ERR_SYSTEM (reported)
 */
int sides_find(const struct scene *scene, const struct sides_lamp *lamps, uint32_t n_lamps, uint32_t *bits,
               uint32_t *n);
