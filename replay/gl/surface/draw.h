/* Draws and clears on a context's surfaces. Does nothing unless a scene is built (x->want). */
#pragma once

#include "replay/build/frame.h"

/* Details of a draw, beside its mesh; as in struct gls_event. */
struct gls_mesh_draw {
	const float (*values)[4];
	uint32_t given, command;
	uint64_t call_number;
};

/** Draw a mesh with the current state. @param mesh  no reference is taken (the scene takes its own) */
void gls_draw_mesh(struct gls_exec *x, struct gls_state *st, struct gls_mesh *mesh, const struct gls_mesh_draw *draw);

/** Draw any event, in any render mode. */
void gls_draw_event(struct gls_exec *x, struct gls_state *st, const struct gls_event *e);

/** Clear; buffers: as in scene_clear. */
void gls_draw_clear(struct gls_exec *x, struct gls_state *st, uint32_t buffers);
