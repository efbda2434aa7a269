/*
 * Lightmaps: textures that hold the light on a wall. They are applied by a second unit that multiplies, or by a
 * second draw of the same points that multiplies the first, and have their own coordinates within [0,1]. Each texel
 * gives a place in the world, its normal, and the light that falls there.
 */
#pragma once

#include <stddef.h>

#include "base/table.h"
#include "look/study/light/occluders.h"
#include "look/study/motion/motion.h"
#include "scene/scene.h"

/* The place of a texel, the side it is seen from, and its light, [0,1]; light above 1 is cut off. */
struct lightmap_texel {
	double at[3], normal[3], light[3];
	unsigned wall; /* index of its mesh */
};

/* All zero: empty. */
struct lightmaps {
	struct lightmap_texel *texels;
	size_t n, room;
	struct occluders walls;  /* everything that stands still */
	struct table seen;       /* the meshes it contains */
	unsigned n_units, n_passes; /* walls lit by a second unit, and by a second draw */
	unsigned unit;              /* the number of that unit */
	unsigned n_colors;          /* meshes whose vertex colours hold light (baked.h) */
};

/** Study one more frame, after motion_add. @return 0 or ERR_SYSTEM (reported) */
int lightmaps_add(struct lightmaps *l, const struct scene *scene, const struct motion *motion);

/* How lightmaps_walk selects draws of static meshes. */
struct lightmaps_kind {
	/* The key of a draw; draws with the same key are taken once. 0: the draw is not wanted */
	uint64_t (*key_of)(const struct scene *scene, const struct scene_instance *instance, const struct motion_thing *thing);
	int (*put)(struct lightmaps *l, const struct scene *scene, const struct scene_instance *instance,
	           const struct motion_thing *thing);
};

/** Put the selected draws that were not taken before. @return 0, the error of put, or ERR_SYSTEM (reported) */
int lightmaps_walk(struct lightmaps *l, const struct scene *scene, const struct motion *motion,
                   const struct lightmaps_kind *kind);

/** Add a mesh that blocks light. @return 0 or ERR_SYSTEM (reported) */
int lightmaps_put_occluder(struct lightmaps *l, const struct scene_mesh *mesh, const double world[16]);
void lightmaps_free(struct lightmaps *l);

/** 1 if a draw only multiplies the picture by its texture and writes no depth. */
int lightmaps_is_pass(const struct scene_material *m);
