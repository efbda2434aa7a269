/* Events of one surface in front of those of another. */
#include <stdlib.h>

#include "base/memory.h"
#include "replay/build/frame.h"
#include "replay/build/material.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

/* Depth and stencil begin as a window's do: what drew the picture left others in its object. */
static int add_clear(struct gls_frame *f, const struct scene_clear *clear, const struct scene_draw *name)
{
	struct scene *s = f->out;

	if (MEMORY_GROW(s->clears, f->room.clears, s->n_clears + 1) || MEMORY_GROW(s->draws, f->room.draws, f->next_draw + 1))
		return ERR_SYSTEM;
	s->clears[s->n_clears] = *clear;
	s->clears[s->n_clears].buffers &= 6;
	s->clears[s->n_clears].before_instance = s->n_instances;
	s->clears[s->n_clears++].draw = f->next_draw;
	s->draws[f->next_draw++] = *name;
	return 0;
}

int gls_frame_precede(struct gls_exec *x, struct gls_surface *surface, struct gls_frame *drawn, const float *depth)
{
	struct gls_frame *old = surface->frame;
	const struct scene *shown = old->out;
	struct scene_clear whole = { .scissor = { 0, 0, (int32_t)surface->width, (int32_t)surface->height }, .depth = 1,
		                         .buffers = 6, .stencil_mask = 255 };
	int err = add_clear(drawn, &whole, &shown->draws[0]);

	for (uint32_t i = 0; i < shown->n_clears && !err; i++)
		err = add_clear(drawn, &shown->clears[i], &shown->draws[shown->clears[i].draw]);
	whole.depth = depth ? *depth : 1;
	whole.buffers = 2;
	if (depth && !err)
		err = add_clear(drawn, &whole, &shown->draws[0]);
	if (err) {
		gls_fail(x);
		return 0;
	}
	drawn->last = NULL;
	drawn->known = old->known;
	drawn->known.whole |= 1;
	drawn->colored = 1;
	surface->frame = drawn;
	gls_frame_drop(&(struct gls_surface){ .frame = old });
	return 1;
}
