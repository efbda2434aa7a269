/*
 * What draws are, told by all frames together:
 *
 *   sky         while the viewer walks, it turns with the world and comes along: its place, but for the turn, stays; or
 *               it is painted before the world and all around (layer.h)
 *   view model  the viewer holds it: its modelview stays while the camera moves
 *   particle    a blended texture on faces that all look at the viewer, in frames between which the viewer turns, or on
 *               points
 *   decal, blob shadow   laid on surfaces (laid.h)
 *   HUD         in parallel projection over a world in perspective, and not cut out by the stencil buffer
 *
 * A role is given to all that has its mesh or its texture, and so only where all of that shows it.
 */
#pragma once

#include "look/findings.h"
#include "look/study/kinds.h"
#include "look/study/motion.h"
#include "scene/scene.h"

enum { ROLES_MOST = 64 }; /* meshes or textures of a role */

/* A thing of motion.things as it was when it was last seen. */
struct role_thing {
	double turned[16];           /* its modelview with the camera's turn taken back */
	uint32_t came_along, stayed; /* frames in which the viewer walked, and it did either */
	uint32_t is_flat;            /* 1: it was drawn in parallel projection, as letters are: it is neither sky nor held */
};

struct role_texture {
	uint64_t hash[2];
	uint32_t facing, others; /* blended draws */
	uint32_t points; /* of those that face the viewer */
	uint32_t frames;
	uint64_t last;
};

/* All zero: empty. */
struct roles {
	struct role_thing *things; /* [n_things] */
	size_t n_things, room_things;
	struct role_texture textures[ROLES_MOST];
	unsigned n_textures;
	unsigned hud_draws, hud_frames;
	double camera[16];  /* of the last frame */
	int knows_camera;
	unsigned turns;     /* frames between which the viewer turned */
	struct kinds kinds; /* what each frame alone tells: layers of a sky, decals, shadows laid on the ground */
};

/** Study one more frame, after motion_add. @return 0 or ERR_SYSTEM (reported) */
int roles_add(struct roles *r, const struct scene *scene, const struct motion *motion);
void roles_free(struct roles *r);

/** Rules for surfaces. @param is_relit  1: surfaces that OpenGL does not light get other lights */
void roles_find(const struct roles *r, const struct motion *motion, int is_relit, struct findings *out);
