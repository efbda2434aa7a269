/* Collects the contents of a glTF file from a scene. */
#pragma once

#include "scene/gltf_pieces.h"

/** Fill all of it; if memory runs out, sets g->failed. Call gltf_free in any case. */
void gltf_gather(struct gltf *g, const struct scene *s, struct gltf_losses *losses);

/** Kind of glTF camera for a view's projection: 1 perspective, 2 orthographic, 0 none. */
int gltf_camera_kind(const float projection[16]);
