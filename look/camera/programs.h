/* Moves vertices that programs place (scene/program.h): clip positions seen from another camera are an affine
 * function of the program's output. */
#pragma once

#include "scene/scene.h"

/** 1 if a program places the vertices of a draw. */
int programs_place(const struct scene *scene, const struct scene_instance *instance);

/** 1 if a view's projection determines how such a program sees, and the program has room for the instructions that
 * move its vertices. */
int programs_can_move(const struct scene *scene, const struct scene_instance *instance);

/** Give a copy of a scene its own programs. @return 0 or ERR_SYSTEM (reported) */
int programs_copy(const struct scene *scene, struct scene *out);

/**
 * Move one draw, which gets a program and a material of its own.
 * @param instance    of the scene
 * @param moved       from the scene's eye space to the new one
 * @param projection  the new one
 * @param out         with room for one more material
 * @param to          the draw in `out`
 * @return 0 or ERR_SYSTEM (reported)
 */
int programs_move(const struct scene *scene, const struct scene_instance *instance, const float moved[16],
                  const float projection[16], struct scene *out, struct scene_instance *to);
