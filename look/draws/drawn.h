/* Properties of a draw's state that rules and studies ask for. */
#pragma once

#include "scene/scene.h"

/** 1 if a view's projection is parallel. */
int drawn_in_parallel(const struct scene_view *view);

/** 1 if a projection mirrors: triangles that run clockwise in eye space run counterclockwise in the window. */
int drawn_mirrored(const struct scene_view *view);

/** 1 if a draw multiplies the picture by its own colour. */
int drawn_multiplies(const struct scene_material *m);

/** 1 if a unit's texture coordinates are generated from reflection. */
int drawn_with_environment(const struct scene *s, const struct scene_material *m);
