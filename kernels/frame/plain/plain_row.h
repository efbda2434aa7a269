/* Rows of sixteen pixels of a plain frame (kernels/frame/plain/plain.h), as processed by its kernels. OpenCL C only. */
#pragma once

#include "kernels/frame/pack/pack_compose.h"
#include "kernels/frame/pack/pack_ray.h"
#include "kernels/frame/pack/pack_shade.h"
#include "kernels/frame/plain/plain.h"

/* Sixteen fragments of a row, one per pixel. */
struct plain_row {
	struct pack_list list;
	uint x, y, base; /* first pixel in the band; its index among the rays (SCENE_NONE: the block has none) */
	uint dimmed;     /* a bit for each fragment that some light does not fully reach */
};

/* Their colours. */
struct plain_colors {
	struct vec4_16 gl, shadowed, direct, albedo;    /* albedo: only if requested */
	int is_gl;                                      /* 1: shadowed and direct equal gl and are not set */
};

/* Test whether packs support everything that a material needs; other fragments are shaded one by one. */
static inline int plain_knows(const struct shade_arguments *s, __global const struct scene_material *m)
{
	return pack_is_plain(s, m) && !pack_refuses_rays(m);
}

/*
 * Transpose the fragments of a row that is entirely in the rectangle, from records to rows. @return a bit for each
 * pixel that has one
 */
WIDE_VECTORS static inline uint load_whole_row(const struct plain_arguments *a, const struct plain_row *at,
                                               struct pack_list *list)
{
	__global const float *words = (__global const float *)(a->sparse + at->y * a->width + at->x);
	const packu place = as_uint16(PACK_LANES) * 6;
	packf first[4], last[4];

	pack_gather_from(words, place, first);
	pack_gather_from(words, place + 2, last);
	*(pack_loose_uints *)list->instance = as_uint16(first[1]);
	*(pack_loose_uints *)list->primitive = as_uint16(first[2]);
	*(pack_loose_floats *)list->b1 = first[3];
	*(pack_loose_floats *)list->b2 = last[2];
	*(pack_loose_floats *)list->depth = last[3];
	return pack_bits(as_uint16(first[0]) != SCENE_NONE);
}

static inline uint load_row(const struct plain_arguments *a, struct plain_row *row)
{
	const struct camera_rectangle r = a->rectangle;
	uint lanes = 0;

	*(pack_loose_uints *)row->list.item = row->base + as_uint16(PACK_LANES);
	*(pack_loose_uints *)row->list.pixel = a->first_pixel + row->y * a->width + row->x + as_uint16(PACK_LANES);
	if ((int)row->y >= r.y0 && (int)row->y < r.y1 && (int)row->x >= r.x0 && (int)(row->x + PACK_SIZE) <= r.x1)
		return load_whole_row(a, row, &row->list);
	for (uint lane = 0; lane < PACK_SIZE; lane++) {
		const struct fragment f = plain_fragment(a, row->x + lane, row->y);
		const uint there = f.order != SCENE_NONE;

		row->list.instance[lane] = f.instance;
		row->list.primitive[lane] = f.primitive;
		row->list.b1[lane] = f.b1;
		row->list.b2[lane] = f.b2;
		row->list.depth[lane] = f.depth;
		lanes |= there << lane;
	}
	return lanes;
}

/* A bit for each fragment of a row that some light does not fully reach. base: its index among the rays; lanes:
 * existing fragments */
static inline uint plain_dimmed(const struct plain_arguments *a, uint base, uint lanes)
{
	uint dimmed = 0;

	for (uint left = lanes; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);

		if (stage_dimmed(a->visibility, a->n_slots, a->n, base + lane))
			dimmed |= 1u << lane;
	}
	return dimmed;
}

/*
 * Load row k of a block, except for its pixels. n_slots: of lights whose visibility is known; 0: nothing is dimmed
 * @return a bit for each pixel that has a fragment
 */
static inline uint plain_load_row(const struct plain_arguments *a, uint n_slots, uint block, uint k,
                                  struct plain_row *row)
{
	uint lanes;

	row->x = block % plain_columns(a->width) * PLAIN_WIDTH;
	row->y = block / plain_columns(a->width) * PLAIN_ROWS + k;
	row->base = plain_base(a->blocks[block], k);
	row->dimmed = 0;
	lanes = row->base != SCENE_NONE && row->y < a->request.height ? load_row(a, row) : 0;
	if (n_slots)
		row->dimmed = plain_dimmed(a, row->base, lanes);
	return lanes;
}

/* The fragment of a lane. */
static inline struct fragment plain_row_fragment(const struct plain_row *row, uint lane)
{
	struct fragment f;

	f.order = 0;
	f.instance = row->list.instance[lane];
	f.primitive = row->list.primitive[lane];
	f.b1 = row->list.b1[lane];
	f.b2 = row->list.b2[lane];
	f.depth = row->list.depth[lane];
	return f;
}

/* Take a colour of n numbers that plain_program stored for some lanes. from: the first lane's, in its struct shaded */
static inline void plain_take_color(__global const float *from, int n, uint lanes, struct vec4_16 *to)
{
	const uint step = sizeof(struct shaded) / sizeof(float);

	for (uint left = lanes; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);

		for (int i = 0; i < n; i++)
			LANE(CHANNEL(*to, i), float, lane) = from[lane * step + i];
	}
}

/* Test whether rules add no light to a material's colours (kernels/frame/pack/pack_shade.h, pack_direct). */
static inline int plain_adds_nothing(__global const struct scene_material *m)
{
	__global const float *e = m->surface.emission;

	return !m->surface.relit && e[0] == 0.0f && e[1] == 0.0f && e[2] == 0.0f;
}

/*
 * Colours of fragments of one material, which kept->last has placed. s: with visibility once lights have been queried.
 * lights: receives a bit for each light that lights them
 */
static inline void plain_shade(const struct plain_arguments *a, const struct shade_arguments *s,
                               const struct plain_row *row, uint lanes, struct pack_kept *kept, packu *lights,
                               struct plain_colors *out)
{
	const struct tables *t = &a->tables;
	struct pack *p = &kept->last;
	__global const struct geometry *g = &t->geometries[row->list.instance[popcount((lanes & -lanes) - 1)]];
	struct pack_corners_lit again;
	struct pack_texturing texturing;
	struct vec4_16 lit, secondary;

	pack_texture(s, &row->list, p, lanes, kept, &texturing);
	pack_lit_by_planes(s, &row->list, p, lanes, kept, 0, &lit, &secondary);
	if (p->material->fragment_program) {
		plain_take_color(a->shaded[row->base].gl, 4, lanes, &out->gl);
	} else {
		out->gl = pack_finish(t, p, &texturing, &lit, &secondary);
		out->gl = v4_16(pixel_nudge(out->gl.x), pixel_nudge(out->gl.y), pixel_nudge(out->gl.z), out->gl.w);
	}
	if (a->request.half_plane[COMPOSE_ALBEDO] != SCENE_NONE)
		out->albedo = pack_albedo(t, &row->list, p, lanes, &texturing, &lit);
	*lights = a->n_slots && !s->n_slots ? pack_lights(t, p) : (packu)(0);
	out->is_gl = !(lanes & row->dimmed) && !stage_is_by_program(s, p->material, g->flags) &&
	             plain_adds_nothing(p->material);
	if (out->is_gl)
		return;
	out->shadowed = out->gl;
	if (stage_is_by_program(s, p->material, g->flags)) {
		plain_take_color(a->shaded[row->base].shadowed, 3, lanes & row->dimmed, &out->shadowed);
	} else if (lanes & row->dimmed && !p->material->surface.relit) {
		pack_light_again(s, &row->list, p, lanes & row->dimmed, kept, &again);
		pack_lit_by_planes(s, &row->list, p, lanes & row->dimmed, kept, &again, &lit, &secondary);
		lit = pack_finish(t, p, &texturing, &lit, &secondary);
		lit = v4_16(pixel_nudge(lit.x), pixel_nudge(lit.y), pixel_nudge(lit.z), out->gl.w);
		out->shadowed = v4_choose(pack_mask(row->dimmed), lit, out->gl);
	}
	out->direct = pack_direct(s, &row->list, p, lanes, &texturing, &out->shadowed, lights);
}

/* Send rays to the lights that light them. lights: a bit for each */
static inline void plain_send_rays(const struct plain_arguments *a, const struct plain_row *row, const struct pack *p,
                                   struct pack_surface *s, packu lights, uint lanes)
{
	__global const struct scene_light *light = pack_lights_of(&a->tables, p->material);
	const struct vec3_16 back = v3_scale(v3_normalize(pack_view_direction(p, a->height)), (packf)(-1));
	struct pack_curve curve;

	pack_measure(p, s);
	pack_curve_of(&a->tables, p, s, &curve);
	for (uint slot = 0; slot < a->n_slots; slot++) {
		__global struct ray *rays = a->rays + slot * a->n;
		const uint wanted = lanes & pack_bits((lights >> slot & 1) != 0);

		if (wanted)
			pack_light_rays(p, s, &curve, back, &light[slot], wanted, row->list.item, rays);
		for (uint left = lanes & ~wanted; left; left &= left - 1)
			stage_no_ray(&rays[row->list.item[popcount((left & -left) - 1)]]);
	}
}
