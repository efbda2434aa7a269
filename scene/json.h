/* A scene as JSON, whose names are those of scene.h, or as text for people: one line per event. */
#pragma once

#include <stdio.h>

#include "scene/scene.h"

/**
 * Write a scene as one JSON object and a newline.
 * @param vertices  1: with the arrays of its meshes
 */
void scene_write_json(FILE *out, const struct scene *scene, int vertices);

/** Write one line about the scene and one per instance and clear, in the order of their draws. */
void scene_write_text(FILE *out, const struct scene *scene);
