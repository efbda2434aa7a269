/*
 * Sheets block light only on the sides that they show. If a program draws one side of a wall, by culling or by
 * lighting, the other side is undefined, and light from there passes. Closed bodies still block, since light meets
 * their outside first.
 */
#pragma once

#include "scene/scene.h"

enum sides_shown {
	SIDES_BOTH,  /* nothing distinguishes them */
	SIDES_FRONT, /* the back is culled */
	SIDES_BACK,
	SIDES_LIT, /* the side that its normals point to */
};

/* The sides of its triangles that an instance shows. */
struct sides {
	enum sides_shown shown;
	int clockwise; /* 1: corners of shown triangles (SIDES_BOTH: of front ones) run clockwise in object space */
};

struct sides sides_of(const struct scene *scene, const struct scene_instance *in);

/**
 * @param out  a triangle's cross product in object space, on the visible side; all 0 if both sides are visible by its
 * normals
 */
void sides_towards(const struct scene *scene, const struct scene_instance *in, struct sides sides, uint32_t primitive,
                   double out[3]);

/** 1 if an instance shows the backs of most of its triangles, by area; a glass body then has its backs outside. */
int sides_back_outside(const struct scene *scene, const struct scene_instance *in);

/* A light, listed once for all materials that it lights. */
struct sides_lamp {
	float position[4]; /* as in scene_light */
	uint32_t space;    /* as in scene_view */
};

/**
 * Find the instances that have a lamp behind them, so that rays to it must be tested for the side that they meet.
 * Closed bodies that show their outside are excluded: from outside, they stop a ray wherever it goes through.
 * (Blended and alpha-tested ones are included, because each side that counts dims the light.) A mesh drawn twice,
 * once for each side, shows both.
 *
 * @param lamps  NULL: light may come from anywhere
 * @param bits   [n_instances]: receives SCENE_ONE_SIDED, and SCENE_SHOWN_* if the winding determines its sides
 * @param n      increased by the number of instances
 * @return 0 or ERR_SYSTEM (reported)
 */
int sides_find(const struct scene *scene, const struct sides_lamp *lamps, uint32_t n_lamps, uint32_t *bits,
               uint32_t *n);
