/*
 * Static things that a frame omits because the viewer cannot see them, but that mirrors and shadows need (`unseen` in
 * look/rules/rules.h). They come from the scenes of other frames.
 */
#pragma once

#include "scene/scene.h"

struct look;

/**
 * Add what a scene omits, for all rays but the camera's. A mesh is not added if the frame proves that it is gone or
 * has been replaced: some of it would be in view with nothing in front.
 * @param look  its rules' scenes are loaded (look.unseen)
 * @param out   a copy that borrows what has not changed; call unseen_release before the scene is released. If nothing
 * is added, or the frame's place in the world is unknown, its instances are NULL
 * @return 0 or ERR_SYSTEM (reported)
 */
int unseen_add(const struct look *look, const struct scene *scene, struct scene *out);
void unseen_release(struct scene *added);
