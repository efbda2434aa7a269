#include "replay/gl/geometry/waiting.h"

#include <string.h>

#include "replay/machine/state.h"

void gls_color_changed(struct gls_state *st)
{
	for (unsigned side = 0; side < 2; side++)
		gls_set_face_colors(&st->a.lighting.face[side], gls_tracked_colors(&st->a.lighting, side),
		                    st->a.current.attribute[GLS_ATTR_COLOR]);
	st->dirty |= GLS_DIRTY_MATERIAL;
	st->waiting.covers = 0;
}

void gls_waiting_set(struct gls_state *st, unsigned side, unsigned colors, const float value[4])
{
	struct gls_waiting *w = &st->waiting;

	if (!colors)
		return;
	w->set[side] |= colors;
	w->touched = 1;
	gls_set_face_colors(&w->face[side], colors, value);
}

void gls_waiting_touch(struct gls_state *st, int carries, int recolors)
{
	struct gls_waiting *w = &st->waiting;

	w->touched = 1;
	w->recolored |= recolors;
	w->colored |= carries && (st->begin_mode || w->placed);
}

void gls_waiting_components(struct gls_state *st, unsigned attribute, unsigned n, float value[4])
{
	uint8_t *room = &st->waiting.room[attribute], *filled = &st->waiting.filled[attribute];
	const float *last = st->a.current.attribute[attribute];

	if (n > *room)
		*room = *filled = (uint8_t)n;
	else if (n < *filled)
		*filled = (uint8_t)n;
	else if (n == *filled)
		memcpy(value + n, last + n, (*room - n) * sizeof(*value));
}

static void take_face(struct gls_state *st, unsigned side)
{
	const struct gls_waiting *w = &st->waiting;
	const struct scene_face *from = &w->face[side];
	struct scene_face *to = &st->a.lighting.face[side];

	gls_set_face_colors(to, w->set[side] & GLS_AMBIENT, from->ambient);
	gls_set_face_colors(to, w->set[side] & GLS_DIFFUSE, from->diffuse);
	gls_set_face_colors(to, w->set[side] & GLS_SPECULAR, from->specular);
	gls_set_face_colors(to, w->set[side] & GLS_EMISSION, from->emission);
}

void gls_waiting_take(struct gls_state *st, int empties)
{
	struct gls_waiting *w = &st->waiting;
	const struct gls_lighting *l = &st->a.lighting;

	if (!gls_is_mesa(st))
		return;
	if (!w->touched && !empties)
		return;
	for (unsigned side = 0; side < 2; side++) {
		take_face(st, side);
		if (l->color_material && w->set[side] & gls_tracked_colors(l, side)) {
			w->covers = 1;
			st->dirty |= GLS_DIRTY_MATERIAL;
		}
	}
	if (w->recolored && l->color_material)
		gls_color_changed(st);
	w->touched = w->recolored = 0;
	w->stored = !empties;
	if (!empties)
		return;
	w->set[0] = w->set[1] = w->placed = w->colored = 0;
	memset(w->room, 0, sizeof(w->room));
}

void gls_waiting_current(struct gls_state *st)
{
	if (st->waiting.recolored && st->a.lighting.color_material)
		gls_color_changed(st);
	st->waiting.touched = st->waiting.recolored = 0;
}

void gls_waiting_begin(struct gls_state *st)
{
	if (!st->waiting.placed)
		gls_waiting_take(st, 1);
	st->waiting.placed = st->waiting.stored = 1;
}
