/* Current values of attributes that a draw's mesh does not have (GL 2.1 sec. 2.7). */
#pragma once

#include <stdint.h>

struct gls_exec;
struct gls_frame;
struct scene_material;
struct scene_mesh;

/** Store the attributes that the material uses and the mesh lacks. @return their index in the scene */
uint32_t gls_frame_current(struct gls_exec *x, struct gls_frame *f, const struct scene_mesh *mesh,
                           const struct scene_material *m, const float (*values)[4]);
