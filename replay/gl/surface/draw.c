/* Draws and clears: applies the state to the surfaces that it draws to. */
#include "replay/gl/surface/draw.h"

#include "replay/build/mesh.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/surface/screen.h"
#include "replay/gl/surface/shown.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/programs/program.h"

/* 1 if an event can change a surface. If its colours go elsewhere, only depth and stencil matter. */
static int is_reached(const struct gls_target *target, const struct gls_event *e)
{
	const struct gls_attribs *a = e->attribs;
	const struct scene_rectangle *r = e->rectangle;

	return target->colored || (a->depth.enabled && a->depth.write) || a->stencil.enabled ||
	       (r && (r->kind == SCENE_DEPTH_PIXELS || r->kind == SCENE_STENCIL_PIXELS));
}

void gls_draw_event(struct gls_exec *x, struct gls_state *st, const struct gls_event *e)
{
	struct gls_target targets[2];
	struct gls_drawn drawn;
	const char *lack;
	uint64_t keys[SCENE_DRAW_PROGRAMS];
	unsigned n, added = 0;

	if (!x->want || gls_refuses(x, st, gls_program_is_refused(st, e->rectangle != NULL), GL_INVALID_OPERATION))
		return;
	drawn = gls_shown_by_draw(x, st, e);
	gls_units_update(x, st, &e->attribs->texturing);
	n = gls_targets_of(x, st, targets);
	for (unsigned i = 0; i < n; i++) {
		if (n == 1 || is_reached(&targets[i], e))
			added |= (unsigned)gls_frame_add(x, &targets[i], st, e);
		else
			gls_frame_pass(targets[i].surface);
	}
	st->dirty = 0;
	gls_shown_end(x, st, drawn);
	n = added ? gls_program_current(st, keys) : 0;
	for (unsigned i = 0; i < n; i++)
		if (table_set(&x->counts.program_draws, keys[i],
		              (void *)((uintptr_t)table_find(&x->counts.program_draws, keys[i]) + 1)))
			gls_fail(x);
	if (added && (lack = gls_program_lack(st))) {
		x->counts.programs++;
		gls_unsupported(x, gls_reason(x, lack));
	}
}

void gls_draw_mesh(struct gls_exec *x, struct gls_state *st, struct gls_mesh *mesh, const struct gls_mesh_draw *draw)
{
	if (gls_is_drawn(x, st))
		gls_draw_event(x, st,
		               &(struct gls_event){ .attribs = &st->a,
		                                    .mesh = mesh,
		                                    .values = draw->values,
		                                    .given = draw->given,
		                                    .command = draw->command,
		                                    .call_number = draw->call_number });
}

void gls_draw_clear(struct gls_exec *x, struct gls_state *st, uint32_t buffers)
{
	struct gls_target targets[2];
	unsigned n;

	if (!gls_is_drawn(x, st) || !buffers)
		return;
	n = gls_targets_of(x, st, targets);
	for (unsigned i = 0; i < n; i++)
		if (n == 1 || targets[i].colored || buffers & 6)
			gls_frame_clear(x, &targets[i], st, buffers);
}
