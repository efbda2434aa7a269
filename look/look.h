/*
 * A scene under rules (look/rules.h). OpenGL's own picture stays as it was: rules change what the tracer adds to it.
 */
#pragma once

#include "look/spare.h"
#include "scene/scene.h"

struct look;

/**
 * A scene under the rules.
 * @param look   NULL: none; what does harm is spared all the same (look/spare.h)
 * @param out    a copy that borrows what has not changed; free it with look_release before the scene
 * @param found  receives what is spared, or would be if rules did not say no; spare_free. NULL: not asked for
 * @return 0 or ERR_SYSTEM (reported)
 */
int look_apply(const struct look *look, const struct scene *scene, struct scene *out, struct spare *found);
/** 1 unless rules say `spare: no`. @param look  NULL: none */
int look_spares(const struct look *look);

void look_release(struct scene *changed);

/**
 * Tell of each role that rules give in a frame, one line of text each, for the reader of a report: "surface", its role, confidence, draw
 * numbers ("3-7,12", cut off where they are too many) and why, with tabs between them. Of a light: "light", and its place in eye space.
 * @param tell  called for each; ends the telling where it returns an error
 * @return 0, tell's error, or ERR_SYSTEM (reported)
 */
int look_tell(const struct look *look, const struct scene *scene, int (*tell)(void *user, const char *text), void *user);

/** 1 where a view shows its space in parallel projection. */
int look_is_parallel(const struct scene_view *view);

/** 1 where a draw multiplies what is there by its own colour. */
int look_multiplies(const struct scene_material *m);
