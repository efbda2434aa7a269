/* Replaces a program's meshes by repaired ones and by ones with smooth normals. */
#pragma once

#include "look/apply/applying.h"
#include "scene/repair/repair.h"

/**
 * Give an instance with round faces a mesh with additional normals.
 * @param i       its index in the scene
 * @param placed  the instance as it is now
 * @param m       its material
 * @return 0 or ERR_SYSTEM (reported)
 */
int meshes_smooth(const struct applying *a, uint32_t i, struct scene_instance *placed, struct scene_material *m);

/** How an instance's mesh is to be repaired. @param m  its material under the rules @return 0: it is not */
int meshes_wants_repair(const struct applying *a, const struct scene_instance *in, const struct scene_material *m,
                        struct repair_wants *wants);

/**
 * Show a repaired mesh to all rays but the camera's, by means of a view of the same space that covers no pixel. The
 * program's own mesh is then visible to the camera alone.
 * @return 0 or ERR_SYSTEM (reported)
 */
int meshes_repair(const struct applying *a, uint32_t i);
