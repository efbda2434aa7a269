/* Vertices that programs place (scene/program.h), moved: clip positions, seen from elsewhere, are an affine function of
 * what programs made. */
#pragma once

#include "scene/scene.h"

/** 1 where a program says where the vertices of a draw are. */
int programs_place(const struct scene *scene, const struct scene_instance *instance);

/** 1 where such a program can be told from its view's projection how it sees, and has room for what moves it. */
int programs_can_move(const struct scene *scene, const struct scene_instance *instance);

/** Give a scene's copy programs of its own. @return 0 or ERR_SYSTEM (reported) */
int programs_copy(const struct scene *scene, struct scene *out);

/**
 * Move one draw: it gets a program, and a material, of its own.
 * @param instance    of the scene
 * @param moved       the new eye space from the scene's
 * @param projection  the new one
 * @param out         with room for one more material
 * @param to          the draw in `out`
 * @return 0 or ERR_SYSTEM (reported)
 */
int programs_move(const struct scene *scene, const struct scene_instance *instance, const float moved[16],
                  const float projection[16], struct scene *out, struct scene_instance *to);
