/*
 * Takes a row of sixteen pixels of a plain frame (kernels/frame/plain/plain.h) from fragments to planes, material by
 * material (kernels/frame/pack/pack_shade.h). Fragments that packs do not support are processed one by one. OpenCL C
 * only.
 */
#pragma once

#include "kernels/frame/pack/pack_blend.h"
#include "kernels/frame/plain/plain_row.h"

/* State of a row of sixteen pixels. */
struct shown_row {
	struct plain_row at;
	struct pack_pixels pixels;
	int is_gl; /* 1: the pixels' colours after gl equal gl and are not set */
};

/* Kept from one fragment to the next. */
struct plain_kept {
	struct pack_kept pack;
	struct setup_kept one;
	struct shadow_kept ray;
	struct pack_encoded encoded;
};

/* Set the colours after gl from now on. */
WIDE_VECTORS static inline void spread_gl(struct shown_row *row)
{
	struct pack_pixels *p = &row->pixels;

	for (int i = 0; i < 3 && row->is_gl; i++)
		p->shadowed[i] = p->direct[i] = p->gl[i];
	row->is_gl = 0;
}

/* Set all pixels to the clear values. */
WIDE_VECTORS static inline void clear_row(__global const struct frame_pixel *cleared, struct shown_row *row)
{
	struct pack_pixels *p = &row->pixels;

	row->is_gl = 1;
	for (int i = 0; i < 3; i++) {
		p->gl[i] = cleared->gl[i];
		p->albedo[i] = p->normal[i] = p->position[i] = 0.0f;
	}
	p->gl[3] = cleared->gl[3];
	p->depth = cleared->depth_exact;
	p->drawn = p->id = p->layers = 0.0f;
}

/* --- Sixteen at once --------------------------------------------------------------------------------------------- */

/* The fragments that are visible: those in front of the clear depth. */
WIDE_VECTORS static inline packi shows(const struct plain_arguments *a, __global const struct scene_material *m,
                                       packf depth)
{
	return pixel_compare(m->depth_func, pixel_depth_steps(depth, pixel_depth_bits(a->bits)),
	                     (packu)(a->cleared->depth));
}

/* Store the colours of visible lanes. */
WIDE_VECTORS static inline void put_colors(struct shown_row *row, const struct pack *p, const struct plain_colors *c,
                                           packi show)
{
	struct pack_pixels *to = &row->pixels;

	if (!c->is_gl)
		spread_gl(row);
	for (int i = 0; i < 3; i++) {
		pack_put(&to->gl[i], CHANNEL(c->gl, i), show);
		if (row->is_gl)
			continue;
		pack_put(&to->shadowed[i], c->is_gl ? CHANNEL(c->gl, i) : CHANNEL(c->shadowed, i), show);
		pack_put(&to->direct[i], c->is_gl ? CHANNEL(c->gl, i) : CHANNEL(c->direct, i), show);
	}
	pack_put(&to->gl[3], c->gl.w, show);
	pack_put(&to->drawn, (packf)(1), show);
	pack_put(&to->depth, p->depth, show);
}

/* Store their positions and draw numbers. */
static inline void put_surface(const struct plain_arguments *a, struct shown_row *row, const struct pack *p,
                               const struct pack_surface *s, packi show)
{
	struct pack_pixels *to = &row->pixels;

	if (pack_wants_surface(&a->request))
		pack_put_surface(&a->tables, p, s, show, to);
	for (uint lanes = a->request.float_plane[COMPOSE_ID] != SCENE_NONE ? pack_bits(show) : 0; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);

		LANE(to->id, float, lane) = (float)stage_draw(&a->tables, row->at.list.instance[lane], row->at.list.primitive[lane]);
	}
}

/* Shade fragments of one material. s: with visibility once lights have been queried. @return the lanes that are done */
static inline uint shade_lanes(const struct plain_arguments *a, const struct shade_arguments *s, struct shown_row *row,
                               uint lanes, struct pack_kept *kept)
{
	const struct tables *t = &a->tables;
	__global const struct geometry *g = &t->geometries[row->at.list.instance[popcount((lanes & -lanes) - 1)]];
	struct plain_colors colors;
	struct pack_surface surface;
	struct pack *p = &kept->last;
	const int sends = a->n_slots && !s->n_slots;
	packu lights;
	packi show;

	p->material = &t->materials[g->material];
	p->view = &a->views[g->view];
	lanes = pack_place(s, &row->at.list, lanes, 1, kept, p);
	if (!lanes)
		return 0;
	show = pack_mask(lanes) & shows(a, p->material, p->depth);
	plain_shade(a, s, &row->at, lanes, kept, &lights, &colors);
	put_colors(row, p, &colors, show);
	if (a->request.half_plane[COMPOSE_ALBEDO] != SCENE_NONE)
		for (int i = 0; i < 3; i++)
			pack_put(&row->pixels.albedo[i], CHANNEL(colors.albedo, i), show);
	if (pack_wants_surface(&a->request) || sends)
		pack_surface(t, p, &surface);
	put_surface(a, row, p, &surface, show);
	if (sends)
		plain_send_rays(a, &row->at, p, &surface, lights, lanes);
	return lanes;
}

/* --- One by one -------------------------------------------------------------------------------------------------- */

/* Store a shaded fragment in its lane. */
static inline void put_one(const struct plain_arguments *a, struct shown_row *row, uint lane)
{
	__global const struct shaded *s = &a->shaded[row->at.base + lane];
	const struct fragment f = a->fragments[row->at.base + lane];
	const uint steps = pixel_depth_steps(s->depth, pixel_depth_bits(a->bits));
	struct pack_pixels *to = &row->pixels;

	if (!(s->flags & SHADED_THERE) ||
	    !pixel_compare(a->tables.materials[a->tables.geometries[f.instance].material].depth_func, steps,
	                   a->cleared->depth))
		return;
	spread_gl(row);
	for (uint i = 0; i < 3; i++) {
		LANE(to->gl[i], float, lane) = s->gl[i];
		LANE(to->shadowed[i], float, lane) = s->shadowed[i];
		LANE(to->direct[i], float, lane) = s->direct[i];
		LANE(to->albedo[i], float, lane) = s->albedo[i];
	}
	pack_put_one(&a->tables, a->windows, &f, lane, to);
	LANE(to->gl[3], float, lane) = s->gl[3];
	LANE(to->drawn, float, lane) = 1;
	LANE(to->depth, float, lane) = s->depth;
	LANE(to->id, float, lane) = (float)stage_draw(&a->tables, f.instance, f.primitive);
}

static inline void shade_one(const struct plain_arguments *a, const struct shade_arguments *s, struct shown_row *row,
                             uint lane, struct plain_kept *kept)
{
	const uint item = row->at.base + lane;
	__global const struct geometry *g = &a->tables.geometries[row->at.list.instance[lane]];
	const int is_done = stage_is_by_program(s, &a->tables.materials[g->material], g->flags);
	const struct shadow_ray_arguments r = plain_rays(a);

	if (!s->n_slots && !is_done) {
		a->fragments[item] = plain_row_fragment(&row->at, lane);
		a->pixels[item] = row->at.list.pixel[lane];
	}
	if (!is_done)
		shade_item(s, item, 0, &kept->one);
	for (uint slot = 0; slot < a->n_slots && !s->n_slots; slot++)
		shadow_ray_item(&r, slot * a->n + item, 0, &kept->ray);
	put_one(a, row, lane);
}

/* --- Rows -------------------------------------------------------------------------------------------------------- */

static inline void shade_row(const struct plain_arguments *a, const struct shade_arguments *s, struct shown_row *row,
                             uint lanes, struct plain_kept *kept)
{
	__global const struct scene_material *m;
	uint material;

	while (lanes) {
		const uint bit = lanes & -lanes, same = pack_same_kind(&a->tables, &row->at.list, lanes, &material);
		uint done = 0;

		m = &a->tables.materials[material];
		if (same & bit && plain_knows(s, m))
			done = shade_lanes(a, s, row, same, &kept->pack);
		if (!(done & bit)) {
			shade_one(a, s, row, popcount(bit - 1), kept);
			done |= bit;
		}
		lanes &= ~done;
	}
}

/* dome_apply for the drawn pixels of a row. */
WIDE_VECTORS static inline void light_row(const struct plain_arguments *a, struct pack_pixels *p, uint base)
{
	const packi drawn = p->drawn > 0.0f;
	packf factor[3], lit[3], was, brightest, share;

	for (uint c = 0; c < 3; c++) {
		factor[c] = select((packf)(1), *(__global const pack_loose_floats *)(a->factors + c * a->n + base), drawn);
		lit[c] = p->direct[c] * factor[c];
	}
	was = fmax(fmax(p->direct[0], p->direct[1]), p->direct[2]);
	brightest = fmax(fmax(lit[0], lit[1]), lit[2]);
	share = fmax(was, 1.0f) / brightest;
	for (uint c = 0; c < 3; c++) {
		const packf f = select(factor[c], factor[c] * share, brightest > 1.0f);

		p->shadowed[c] *= fmin(f, 1.0f);
		p->direct[c] += p->direct[c] * (f - 1.0f);
	}
}

/* Convert to the final colours. */
WIDE_VECTORS static inline void finish_row(const struct plain_arguments *a, struct shown_row *row, uint lanes,
                                           int is_lit)
{
	struct pack_pixels *p = &row->pixels;
	const packi odd = (p->gl[0] != p->gl[0]) | (p->gl[1] != p->gl[1]) | (p->gl[2] != p->gl[2]);

	is_lit = is_lit && lanes;
	if (is_lit || a->request.normals || any_pack(odd))
		spread_gl(row);
	if (is_lit)
		light_row(a, p, row->at.base);
	for (int i = 0; i < 3 && !row->is_gl; i++)
		p->mirrored[i] = p->beauty[i] = p->direct[i];
}

/* Index in the planes of a row without fragments; SCENE_NONE: there is none yet. */
struct plain_empty {
	uint at;
};

/*
 * Show a row loaded in plain_row. s: arguments for packs and shade_item, with visibility once lights have been queried
 * lanes: a bit for each pixel that has a fragment is_lit: 1: by the dome
 */
static inline void plain_show_row(const struct plain_arguments *a, const struct shade_arguments *s,
                                  struct shown_row *row, uint lanes, int is_lit, const struct pack_planes *to,
                                  struct plain_kept *kept, struct plain_empty *empty)
{
	if (!lanes && empty->at != SCENE_NONE && to->n == PACK_SIZE) {
		pack_compose_again(empty->at, to);
		return;
	}
	clear_row(a->cleared, row);
	shade_row(a, s, row, lanes, kept);
	finish_row(a, row, lanes, is_lit);
	pack_compose(&row->pixels, row->is_gl, to, &kept->encoded);
	if (!lanes && to->n == PACK_SIZE)
		empty->at = to->at;
}
