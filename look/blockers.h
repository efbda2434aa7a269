/*
 * What stands between a point and a light, for decisions about a scene: a few hundred rays on the host, before anything
 * is traced.
 *
 * Surfaces with holes (alpha test), films (blended, without depth) and those that secondary rays do not see block
 * nothing here. Others that are blended count as opaque: walls are often drawn so.
 */
#pragma once

#include "scene/scene.h"

enum { BLOCKERS_MOST = 32 }; /* hits of a ray that are told; further ones are not */

/* Which side a surface turns to the ray's origin, where it shows only one (look/sides.h). */
enum blocker_side { BLOCKER_UNKNOWN_SIDE, BLOCKER_SHOWN, BLOCKER_OTHER };

struct blocker_hit {
	float t; /* in lengths of the ray's direction */
	uint32_t instance;
	enum blocker_side side;
};

struct blockers;

/** 1 where an instance can block light, by what it is drawn with. is_depth: what scene_find_depths says of it */
int blockers_can(const struct scene *scene, uint32_t instance, int is_depth);

/** @param scene  borrowed until blockers_destroy @return 0 or ERR_SYSTEM (reported) */
int blockers_create(const struct scene *scene, struct blockers **out);
void blockers_destroy(struct blockers **blockers);

/** 1 where an instance can block light. */
int blockers_has(const struct blockers *b, uint32_t instance);

/**
 * Everything on a ray in eye space, in no order.
 * @param space   only instances whose views share this eye space (scene_view.space)
 * @param t_max   the ray's end, in lengths of its direction
 * @return how many hits
 */
unsigned blockers_on(const struct blockers *b, uint32_t space, const float from[3], const float direction[3],
                     float t_max, struct blocker_hit out[BLOCKERS_MOST]);
