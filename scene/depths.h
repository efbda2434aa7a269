/* Surfaces that write only depth, and surfaces that are never drawn. */
#pragma once

#include <stdint.h>

struct scene;
struct scene_material;

/** 1 if a draw can leave neither colour nor depth: both sides are culled, or a test always fails. */
int scene_is_never_drawn(const struct scene_material *m);

/** 1 if two instances are the same geometry at the same place. */
int scene_is_same_body(const struct scene *scene, uint32_t a, uint32_t b);

/**
 * Find solid instances that write depth but no colour, as a depth pre-pass does whose lights follow in passes under
 * GL_EQUAL. Rays must meet them although they have no colour. Not solid are
 *   - instances before the last clear of the whole window's depth: nothing later is compared with them;
 *   - masks and portals: instances under a stencil test, or with a depth function other than GL_LESS and GL_LEQUAL,
 *     which win without being nearest;
 *   - instances whose geometry is later blended over by its alpha: a translucent body that hides only its own back.
 *
 * @param depths  [n_instances], all 0; receives 1 for each such instance
 */
void scene_find_depths(const struct scene *scene, uint8_t *depths);
