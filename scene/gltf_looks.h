/* Materials of a glTF file, with their textures. */
#pragma once

#include "scene/gltf_pieces.h"

/**
 * The texture unit that glTF can show: it has a 2D image whose colour it lets through, and coordinates that are not
 * generated. Among several, one with per-vertex coordinates and a colour texture is preferred, then the first. NULL:
 * none.
 */
const struct scene_unit *gltf_shown_unit(struct gltf *g, const struct scene_material *m, const struct scene_mesh *mesh);

/**
 * The number of a material's look; equal looks share one.
 * @param color          colour of the surface if neither lighting nor vertices give one
 * @param vertex_colors  1: vertices give the colour
 */
uint32_t gltf_put_look(struct gltf *g, const struct scene_material *m, const struct scene_unit *unit,
                       const float color[4], int vertex_colors);
