/*
 * Repaired meshes in a frame (`repair` in look/rules/rules.h). All rays but the camera's meet them in place of the
 * program's meshes, so OpenGL's picture stays. Each mesh is repaired once for all frames.
 */
#pragma once

#include "scene/repair/repair.h"
#include "scene/scene.h"

struct repair_rule;
struct repaired; /* the store of all repaired meshes; threads may share it */

/** @return 0 or ERR_SYSTEM (reported) */
int repaired_create(struct repaired **store);
void repaired_destroy(struct repaired **store);

/**
 * How a rule repairs an instance's mesh.
 * @param m      its material
 * @param wants  receives what repair_mesh is to do
 * @return 1; 0: the mesh cannot be repaired
 */
int repaired_wants(const struct repair_rule *rule, const struct scene *scene, const struct scene_instance *in,
                   const struct scene_material *m, struct repair_wants *wants);

/**
 * Repair a mesh. Leaks that remain are reported on standard error, for the first few meshes.
 * @param mesh  receives the repaired mesh, owned by the store; NULL: there is nothing to repair, or the store is full
 *              (reported once)
 * @return 0 or ERR_SYSTEM (reported)
 */
int repaired_find(struct repaired *store, const struct scene_mesh *of, const struct repair_wants *wants,
                  const struct scene_mesh **mesh, struct repair_found *found);

/** Describe in words how a mesh was repaired. */
void repaired_describe(const struct repair_found *found, char *out, size_t room);
