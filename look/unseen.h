/*
 * What stands still and the frame leaves out, as its program knew that nobody would see it: mirrors and shadows do
 * (`unseen` in look/rules.h). It comes from the scenes of other frames.
 */
#pragma once

#include "scene/scene.h"

struct look;

/**
 * The scene with what it leaves out, for all rays but the camera's. A mesh stays out where the frame itself proves that
 * it is gone, or is another one now: some of it would lie in view with nothing before it.
 * @param look  its rules' scenes are there (look.unseen)
 * @param out   a copy that borrows what has not changed; unseen_release before the scene is. Where nothing is added, or
 *              nobody knows where the frame's world is, instances is NULL
 * @return 0 or ERR_SYSTEM (reported)
 */
int unseen_add(const struct look *look, const struct scene *scene, struct scene *out);
void unseen_release(struct scene *added);
