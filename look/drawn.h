/* How a program draws something, where rules and studies ask the same. */
#pragma once

#include "scene/scene.h"

/** 1 where a view shows its space in parallel projection. */
int drawn_in_parallel(const struct scene_view *view);

/** 1 where a projection mirrors: what runs clockwise in eye space, to its viewer, does not in the window. */
int drawn_mirrored(const struct scene_view *view);

/** 1 where a draw multiplies what is there by its own colour. */
int drawn_multiplies(const struct scene_material *m);

/** 1 where a texture's coordinates are made from what the surface mirrors. */
int drawn_with_environment(const struct scene *s, const struct scene_material *m);
