/*
 * Repaired meshes in a frame (`repair` in look/rules.h): all rays but the camera's meet them in place of what the
 * program drew, so OpenGL's picture stays. A mesh is repaired once for all frames.
 */
#pragma once

#include "scene/repair/repair.h"
#include "scene/scene.h"

struct repair_rule;
struct repaired; /* the store of all meshes so far; threads may share it */

/** @return 0 or ERR_SYSTEM (reported) */
int repaired_create(struct repaired **store);
void repaired_destroy(struct repaired **store);

/** How a rule repairs an instance's mesh. m: its material. @return 0: it is none of those that can be repaired */
int repaired_wants(const struct repair_rule *rule, const struct scene *scene, const struct scene_instance *in,
                   const struct scene_material *m, struct repair_wants *wants);

/**
 * A mesh repaired. What still leaks is told on standard error, of the first few meshes.
 * @param mesh  receives the repaired one, the store's; NULL: nothing is there to repair, or there is no room for more
 * (told once)
 * @return 0 or ERR_SYSTEM (reported)
 */
int repaired_find(struct repaired *store, const struct scene_mesh *of, const struct repair_wants *wants,
                  const struct scene_mesh **mesh, struct repair_found *found);

/** What was done to a mesh, in words. */
void repaired_describe(const struct repair_found *found, char *out, size_t room);
