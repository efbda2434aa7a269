/*
 * Applies rules (look/rules/rules.h) to a scene. OpenGL's own picture stays the same; rules change what the tracer adds
 * to it.
 */
#pragma once

#include "look/spare/spare.h"
#include "scene/scene.h"

struct look;

/**
 * Apply rules to a scene.
 * @param look   NULL: no rules; surfaces that would do harm are spared even so (look/spare/spare.h)
 * @param out    a copy that borrows what has not changed; free it with look_release before the scene
 * @param found  receives what is spared, or would be if rules did not forbid it; free with spare_free. NULL: not
 * wanted
 * @return 0 or ERR_SYSTEM (reported)
 */
int look_apply(const struct look *look, const struct scene *scene, struct scene *out, struct spare *found);
/** 1 unless rules say `spare: no`. @param look  NULL: none */
int look_spares(const struct look *look);

void look_release(struct scene *changed);
