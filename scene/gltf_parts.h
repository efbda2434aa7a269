/* From a scene to what its glTF file holds. */
#pragma once

#include "scene/gltf_pieces.h"

/** Fill all of it; out of memory sets g->failed. gltf_free in any case. */
void gltf_gather(struct gltf *g, const struct scene *s, struct gltf_losses *losses);

/** What a view's projection is as a glTF camera: 1 perspective, 2 orthographic, 0 none. */
int gltf_camera_kind(const float projection[16]);
