/*
 * Lightmaps: textures that hold the light on a wall. They come as a second unit that multiplies, or as a second draw of
 * the same points that multiplies what is there, with coordinates of their own within [0,1]. Each texel is a place in
 * the world, its normal, and how much light falls there.
 */
#pragma once

#include <stddef.h>

#include "base/table.h"
#include "look/study/motion.h"
#include "look/study/occluders.h"
#include "scene/scene.h"

/* A texel's place, the side it is seen from, and its light, [0,1]; 1 may be more. */
struct lightmap_texel {
	double at[3], normal[3], light[3];
	unsigned wall; /* which mesh */
};

/* All zero: empty. */
struct lightmaps {
	struct lightmap_texel *texels;
	size_t n, room;
	struct occluders walls;  /* all that stands still */
	struct table seen;       /* meshes that are in it */
	unsigned n_units, n_passes; /* walls lit by a second unit, and by a second draw */
	unsigned unit;              /* number of that unit */
	unsigned n_colors;          /* meshes whose vertices have light as their colours (baked.h) */
};

/** Study one more frame, after motion_add. @return 0 or ERR_SYSTEM (reported) */
int lightmaps_add(struct lightmaps *l, const struct scene *scene, const struct motion *motion);

/* What is looked for among draws of what stands still. */
struct lightmaps_kind {
	/* Each draw is taken once by its key; 0: it is not looked for */
	uint64_t (*key_of)(const struct scene *scene, const struct scene_instance *instance, const struct motion_thing *thing);
	int (*put)(struct lightmaps *l, const struct scene *scene, const struct scene_instance *instance,
	           const struct motion_thing *thing);
};

/** Put draws of what stands still that were not taken before. @return 0, what put returns, or ERR_SYSTEM (reported) */
int lightmaps_walk(struct lightmaps *l, const struct scene *scene, const struct motion *motion,
                   const struct lightmaps_kind *kind);

/** A mesh stops light. @return 0 or ERR_SYSTEM (reported) */
int lightmaps_put_occluder(struct lightmaps *l, const struct scene_mesh *mesh, const double world[16]);
void lightmaps_free(struct lightmaps *l);

/** 1 where a draw only multiplies what is there: by its texture, and writes no depth. */
int lightmaps_is_pass(const struct scene_material *m);
