/* Meshes of other normals, and repaired ones, in place of a program's own. */
#pragma once

#include "look/apply/applying.h"
#include "scene/repair/repair.h"

/**
 * Give faces that look round a mesh with further normals.
 * @param i       of the scene's instance
 * @param placed  what stands for it now
 * @param m       its material
 * @return 0 or ERR_SYSTEM (reported)
 */
int meshes_smooth(const struct applying *a, uint32_t i, struct scene_instance *placed, struct scene_material *m);

/** How an instance's mesh is repaired. m: its material under the rules. @return 0: it is not */
int meshes_wants_repair(const struct applying *a, const struct scene_instance *in, const struct scene_material *m,
                        struct repair_wants *wants);

/**
 * Let a repaired mesh stand for an instance where only the camera does not look: in a view of the same space that
 * covers no pixel. The program's own stays for the camera alone.
 * @return 0 or ERR_SYSTEM (reported)
 */
int meshes_repair(const struct applying *a, uint32_t i);
