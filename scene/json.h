/* Writes a scene as JSON with the names of scene.h, or as text for people with one line per event. */
#pragma once

#include <stdio.h>

#include "scene/scene.h"

/**
 * Write a scene as one JSON object and a newline.
 * @param vertices  1: include the arrays of its meshes
 */
void scene_write_json(FILE *out, const struct scene *scene, int vertices);

/** Write one line about the scene and one per instance and clear, in the order of their draws. */
void scene_write_text(FILE *out, const struct scene *scene);
