/* Collects the vertices between Begin and End, and draws them as meshes. */
#include "replay/gl/geometry/pending.h"

#include <string.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "capture/format/call.h"
#include "replay/build/mesh.h"
#include "replay/build/program.h"
#include "replay/gl/geometry/waiting.h"
#include "replay/gl/surface/draw.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

void gls_draw_pending(struct gls_exec *x)
{
	struct gls_geometry *g = &x->pending.geometry;
	struct gls_mesh *mesh;
	const uint32_t list = x->drawn_list, command = x->command;

	if (g->n_primitives && x->st) {
		if (g->quads && !x->pending.list &&
		    gls_quads_turn(x->st, gls_shades_flat(x->st), g->position, g->index, g->n_primitives))
			gls_geometry_turn_quads(g);
		mesh = gls_geometry_mesh(x, g);
		x->drawn_list = x->pending.list;
		x->command = x->pending.command; /* unsupported features are attributed to the call that drew, not to
		                                    the current one */
		if (mesh)
			gls_draw_mesh(x, x->st, mesh,
			              &(struct gls_mesh_draw){ (const float(*)[4])g->constant, g->given, x->pending.command,
			                                     x->pending.call });
		x->drawn_list = list;
		x->command = command;
		gls_mesh_release(mesh);
	}
	gls_geometry_clear(g);
}

void gls_flush(struct gls_exec *x)
{
	gls_draw_pending(x);
	if (x->st && x->st->waiting.stored)
		gls_waiting_take(x->st, 1);
}

/* ---- attributes ---- */

/*
 * Most stored vertices that attributes set outside Begin and End still join (Mesa 22.3.6,
 * vbo_exec_wrap_upgrade_vertex): the vertices after them are then given these attributes.
 */
#define MOST_GIVEN_LATER 8

void gls_set_attribute(struct gls_exec *x, struct gls_state *st, unsigned attribute, const float value[4])
{
	float *current = st->a.current.attribute[attribute];
	const int is_color = attribute == GLS_ATTR_COLOR, recolors = is_color && memcmp(current, value, 16) != 0;
	struct gls_geometry *g = &x->pending.geometry;

	memcpy(current, value, 16);
	g->touched |= 1u << attribute;
	if (st->begin_mode || (g->n_vertices && g->n_vertices <= MOST_GIVEN_LATER))
		g->given |= 1u << attribute;
	gls_waiting_touch(st, is_color, recolors);
	if (is_color && st->a.lighting.color_material && !gls_is_mesa(st))
		gls_color_changed(st);
}

/*
 * Materials may change between Begin and End (sec. 2.6.3). Each vertex is lit with the material current at that time,
 * so from here on the material is a vertex attribute.
 */
void gls_before_material(struct gls_exec *x, struct gls_state *st)
{
	struct gls_geometry *g = &x->pending.geometry;

	if (!st->begin_mode && g->n_vertices)
		gls_draw_pending(x);
	else if (g->n_vertices && !(g->varying & SCENE_HAS_FACE))
		gls_geometry_vary_face(x, g, st->a.lighting.face);
	st->dirty |= GLS_DIRTY_MATERIAL;
}

/* ---- vertices ---- */

/* From now on, store an attribute per vertex if it changed since the last vertex. */
static int take_touched(struct gls_exec *x, struct gls_geometry *g, const struct gls_state *st)
{
	for (uint32_t left = g->touched & ~g->varying; left; left &= left - 1) {
		unsigned a = (unsigned)__builtin_ctz(left);
		if (memcmp(g->constant[a], st->a.current.attribute[a], 16) != 0 && gls_geometry_vary(x, g, a))
			return ERR_SYSTEM;
	}
	g->touched = 0;
	return 0;
}

static void add_vertex(struct gls_exec *x, const struct gls_state *st, const float position[4])
{
	struct gls_geometry *g = &x->pending.geometry;
	uint32_t at = g->n_vertices;

	if (at == 0) {
		memcpy(g->constant, st->a.current.attribute, sizeof(g->constant));
		g->touched = 0;
		g->varying = 0;
	} else if (g->touched && take_touched(x, g, st)) {
		return;
	}
	if (at == g->room_vertices && gls_geometry_reserve(x, g, 1, 0))
		return;
	memcpy(g->position + 4 * (size_t)at, position, 16);
	if (g->varying & SCENE_HAS_FACE)
		memcpy(g->face[at], st->a.lighting.face, sizeof(*g->face));
	for (uint32_t varying = g->varying & ((1u << N_GLS_ATTRIBUTES) - 1); varying; varying &= varying - 1) {
		unsigned a = (unsigned)__builtin_ctz(varying);
		memcpy(g->attribute[a] + 4 * (size_t)at, st->a.current.attribute[a], 16);
	}
	g->edge[at] = st->a.current.edge_flag != 0;
	g->n_vertices = at + 1;
}

int gls_takes_vertices(const struct gls_exec *x, const struct gls_state *st)
{
	return st->begin_mode && x->want;
}

void gls_vertex(struct gls_exec *x, struct gls_state *st, const float position[4])
{
	if (gls_takes_vertices(x, st))
		add_vertex(x, st, position);
}

void gls_set_generic(struct gls_exec *x, struct gls_state *st, uint32_t number, const float value[4])
{
	if (gls_refuses(x, st, number > SCENE_MAX_GENERICS, GL_INVALID_VALUE))
		return;
	if (number)
		gls_set_attribute(x, st, GLS_ATTR_GENERIC + number - 1, value);
	else if (st->begin_mode)
		gls_vertex(x, st, value);
	else
		memcpy(st->a.current.generic0, value, sizeof(st->a.current.generic0));
}

/* ---- Begin and End ---- */

void gls_begin(struct gls_exec *x, struct gls_state *st, uint32_t mode)
{
	struct gls_pending *p = &x->pending;
	struct gls_geometry *g = &p->geometry;
	const enum scene_primitive kind = gls_mode_kind(mode);

	if (gls_refuses(x, st, st->begin_mode, GL_INVALID_OPERATION))
		return;
	if (gls_refuses(x, st, !kind, GL_INVALID_ENUM))
		return;
	if (g->n_vertices && (g->kind != kind || g->n_vertices > GLS_MAX_PENDING_VERTICES ||
	                      (!p->mixes && g->quads != (mode == GL_QUADS))))
		gls_draw_pending(x);
	gls_waiting_begin(st);
	g->kind = kind;
	g->quads = mode == GL_QUADS;
	g->begin_vertex = g->n_vertices;
	if (!g->n_vertices) {
		p->call = x->call->number;
		p->command = x->command;
		p->list = x->drawn_list;
	}
	st->begin_mode = mode + 1;
}

/* Split the vertices of the open Begin into triangles, lines or points. */
static void cut_primitives(struct gls_exec *x, const struct gls_state *st)
{
	struct gls_geometry *g = &x->pending.geometry;

	gls_geometry_cut(x, g, st->begin_mode - 1, g->begin_vertex, g->n_vertices - g->begin_vertex, NULL,
	                 (int)st->a.lighting.first_provokes);
}

void gls_end(struct gls_exec *x, struct gls_state *st)
{
	if (gls_refuses(x, st, !st->begin_mode, GL_INVALID_OPERATION))
		return;
	if (x->want) {
		cut_primitives(x, st);
		x->pending.geometry.n_draws++;
	}
	st->begin_mode = 0;
}

void gls_restart(struct gls_exec *x, struct gls_state *st)
{
	struct gls_geometry *g = &x->pending.geometry;

	if (gls_refuses(x, st, !st->begin_mode, GL_INVALID_OPERATION))
		return;
	if (x->want)
		cut_primitives(x, st);
	g->begin_vertex = g->n_vertices;
}
