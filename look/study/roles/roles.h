/*
 * Roles of draws, found by comparing frames:
 *
 *   sky          turns with the world and moves along with the viewer, or is painted before the world all
 *                around the viewer (layer.h)
 *   view model   held by the viewer: its modelview stays the same while the camera moves
 *   particle     a blended texture on points, or on faces that all look at the viewer while the viewer turns
 *   decal, blob shadow   laid on surfaces (laid.h)
 *   HUD          in parallel projection over a world in perspective, and not masked by the stencil buffer
 *
 * A role applies to a mesh or a texture, and so only if all its draws have it.
 */
#pragma once

#include "look/rules/findings.h"
#include "look/study/motion/motion.h"
#include "look/study/roles/kinds.h"
#include "scene/scene.h"

enum { ROLES_MOST = 64 }; /* meshes or textures of a role */

/* A thing of motion.things when it was last seen. */
struct role_thing {
	double turned[16];           /* its modelview, with the camera's rotation undone */
	uint32_t came_along, stayed; /* frames where the viewer walked: it moved along, or it stayed */
	uint32_t is_flat;            /* 1: it was drawn in parallel projection, like text, and so is neither sky nor
	                                held */
};

struct role_texture {
	uint64_t hash[2];
	uint32_t facing, others; /* blended draws that face the viewer, and others */
	uint32_t points; /* `facing` draws of points */
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
	double camera[16];  /* in the last frame */
	int knows_camera;
	unsigned turns;     /* frames that the viewer turned before */
	struct kinds kinds; /* roles known from single frames: layers of a sky, decals, shadows laid on the ground */
};

/** Study one more frame, after motion_add. @return 0 or ERR_SYSTEM (reported) */
int roles_add(struct roles *r, const struct scene *scene, const struct motion *motion);
void roles_free(struct roles *r);

/** Rules for surfaces. @param is_relit  1: surfaces that OpenGL does not light get other lights */
void roles_find(const struct roles *r, const struct motion *motion, int is_relit, struct findings *out);
