/* Materials of a glTF file, with their textures. */
#pragma once

#include "scene/gltf_pieces.h"

/**
 * The unit that glTF can show: with a 2D image, whose colour it lets through, and coordinates that are not generated.
 * Of several one with coordinates for each vertex and a texture in colours, then the first. NULL: none.
 */
const struct scene_unit *gltf_shown_unit(struct gltf *g, const struct scene_material *m, const struct scene_mesh *mesh);

/**
 * The number of a material's look; equal ones are one.
 * @param color          where neither lighting nor vertices give one
 * @param vertex_colors  1: vertices do
 */
uint32_t gltf_put_look(struct gltf *g, const struct scene_material *m, const struct scene_unit *unit,
                       const float color[4], int vertex_colors);
