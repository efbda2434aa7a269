/*
 * Surfaces between a point and a light. The host casts a few hundred rays to make decisions about a scene before it
 * is traced.
 *
 * Surfaces with holes (alpha test), films (blended, without depth) and those invisible to secondary rays block
 * nothing here. Other blended surfaces count as opaque, because walls are often drawn that way.
 */
#pragma once

#include "scene/scene.h"

enum { BLOCKERS_MOST = 32 }; /* the number of hits reported for a ray; more are dropped */

/* The side that a surface turns to the ray's origin, if it shows only one (look/spare/sides.h). */
enum blocker_side { BLOCKER_UNKNOWN_SIDE, BLOCKER_SHOWN, BLOCKER_OTHER };

struct blocker_hit {
	float t; /* distance in lengths of the ray's direction */
	uint32_t instance;
	enum blocker_side side;
};

struct blockers;

/**
 * 1 if an instance can block light, judging by its material. @param is_depth  the result of scene_find_depths for it
 */
int blockers_can(const struct scene *scene, uint32_t instance, int is_depth);

/** @param scene  borrowed until blockers_destroy @return 0 or ERR_SYSTEM (reported) */
int blockers_create(const struct scene *scene, struct blockers **out);
void blockers_destroy(struct blockers **blockers);

/** 1 if an instance can block light. */
int blockers_has(const struct blockers *b, uint32_t instance);

/**
 * Find everything on a ray in eye space, in no particular order.
 * @param space   only instances whose views share this eye space (scene_view.space)
 * @param t_max   the ray's end, in lengths of its direction
 * @return the number of hits
 */
unsigned blockers_on(const struct blockers *b, uint32_t space, const float from[3], const float direction[3],
                     float t_max, struct blocker_hit out[BLOCKERS_MOST]);
