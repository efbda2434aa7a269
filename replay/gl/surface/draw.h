/* Draws and clears on a context's surfaces. Does nothing unless a scene is built (x->want). */
#pragma once

#include "replay/build/frame.h"

/**
 * Draw a mesh with the current state.
 * @param mesh    no reference is taken (the scene takes its own)
 * @param values  values of attributes that the mesh lacks
 */
void gls_draw_mesh(struct gls_exec *x, struct gls_state *st, struct gls_mesh *mesh, const float (*values)[4],
                   uint32_t command, uint64_t call_number);

/** Draw any event, in any render mode. */
void gls_draw_event(struct gls_exec *x, struct gls_state *st, const struct gls_event *e);

/** Clear; buffers: as in scene_clear. */
void gls_draw_clear(struct gls_exec *x, struct gls_state *st, uint32_t buffers);
