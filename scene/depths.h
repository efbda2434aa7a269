/* Surfaces that a frame draws into the depth buffer alone, or not at all. */
#pragma once

#include <stdint.h>

struct scene;
struct scene_material;

/** 1 where a draw leaves neither colour nor depth: both sides are culled, or a test always fails. */
int scene_is_never_drawn(const struct scene_material *m);

/** 1 where two instances are the same geometry at the same place. */
int scene_is_same_body(const struct scene *scene, uint32_t a, uint32_t b);

/**
 * Find instances that write depth and no colour, and are solid: depth counts, not colour. A depth pre-pass, whose light
 * comes in passes under GL_EQUAL, is one. Not solid are
 *   - those whose depth a later clear of the whole window drops: what follows is not compared with them;
 *   - those under a stencil test, and those that win without being nearest (a depth function other than GL_LESS and
 *     GL_LEQUAL): masks and portals;
 *   - those that the same geometry is then blended over by its alpha: a body that is seen through, but not its own
 *     back.
 *
 * @param depths  [n_instances], all 0; receives 1 for each
 */
void scene_find_depths(const struct scene *scene, uint8_t *depths);
