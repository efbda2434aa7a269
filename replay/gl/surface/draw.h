/* Drawing and clearing: what a context does reaches its surfaces here. Nothing happens where no scene is built (x->want
 * 0). */
#pragma once

#include "replay/build/frame.h"

/**
 * Draw a mesh with the state as it is.
 * @param mesh    no reference is taken (the scene takes its own)
 * @param values  attributes that the mesh does not give
 */
void gls_draw_mesh(struct gls_exec *x, struct gls_state *st, struct gls_mesh *mesh, const float (*values)[4],
                   uint32_t command, uint64_t call_number);

/** The same of any event, whatever the render mode is. */
void gls_draw_event(struct gls_exec *x, struct gls_state *st, const struct gls_event *e);

/** Clear; buffers: as in scene_clear. */
void gls_draw_clear(struct gls_exec *x, struct gls_state *st, uint32_t buffers);
