/*
 * Fragments of a row of sixteen pixels, layer by layer: how layered.cl loads, tests and blends them. Layer i holds the
 * i-th fragment of each pixel, in draw order. OpenCL C only.
 */
#pragma once

#include "kernels/frame/pack/pack_blend.h"
#include "kernels/frame/plain/plain_row.h"

/* One layer: at most one fragment of each pixel. Masks have one bit per lane. */
struct layer {
	struct plain_row at;
	struct plain_colors colors;   /* colours of the fragments in `shaded` */
	packf mirrored[3], beauty[3]; /* theirs with the light that their paths found; set if row.is_mirrored */
	packf depth;
	struct pack pack; /* the fragments in `placed`, all of one material */
	uint there;       /* mask: pixels that have a fragment */
	uint placed;      /* mask: fragments that `pack` holds */
	uint drawn;       /* mask: passed all tests, and may write colours */
	uint shaded;      /* mask: colours are known */
	uint covered;     /* mask: pixels where later layers leave nothing of this one */
	uint leaving;     /* mask: visible fragments that light leaves, as they mirror or transmit it */
	uint look;        /* the look that found these fragments */
	uint from, slots; /* index of the first pixel's fragment in a->sparse; distance to the next pixel's */
	int sends_rays;   /* 1: fragments send rays to lights, if these light them */
	int may_leave;    /* 1: light may leave fragments */
};

/* State of a row of sixteen pixels. */
struct layered_row {
	struct layer layers[PLAIN_LAYERS];
	struct pack_pixels pixels;
	packu depth;         /* in the depth buffer's format */
	uint step;           /* PLAIN_FIRST, PLAIN_SHADOW, PLAIN_MIRROR */
	packu last, surface; /* layer of the last fragment drawn, and of the visible surface; SCENE_NONE: none */
	uint n;          /* number of layers */
	uint unknown;    /* mask: pixels that still show colours from before the frame, which are not known */
	int is_mirrored; /* 1: mirrored and beauty differ from direct */
	int at_once;     /* 1: each layer is shaded and drawn as soon as it is tested. Set by a row of the block where all
	                    drawn fragments had to be shaded */
};

/* --- Loading ----------------------------------------------------------------------------------------------------- */

/* Number of fragments of each pixel of a row in a look. */
static inline packu load_counts(const struct plain_arguments *a, uint look, uint x, uint y)
{
	__global const uint *counts = a->layers.counts +
	                              plain_look_first(a->layers.columns, look, a->width * a->request.height) +
	                              y * a->width + x;
	packu n = 0;

	if (x + PACK_SIZE <= a->width)
		return *(__global const pack_loose_uints *)counts;
	for (uint lane = 0; lane < a->width - x; lane++)
		LANE(n, uint, lane) = counts[lane];
	return n;
}

/* The largest of sixteen numbers. */
static inline uint most_of(packu n)
{
	uint most = 0;

	for (uint lane = 0; lane < PACK_SIZE; lane++)
		most = max(most, LANE(n, uint, lane));
	return most;
}

/* The layers of a block (PLAIN_ROWS rows of sixteen pixels). */
struct layered_block {
	uint x, y;              /* its first pixel */
	uint place;             /* index of its first layer; SCENE_NONE: it has no fragments */
	uint most[PLAIN_LOOKS]; /* number of layers of each look */
	uint n;                 /* their sum */
};

/* Find the layers of block number `item`. */
static inline void load_block(const struct plain_arguments *a, uint item, struct layered_block *b)
{
	b->x = item % plain_columns(a->width) * PLAIN_WIDTH;
	b->y = item / plain_columns(a->width) * PLAIN_ROWS;
	b->place = a->blocks[item];
	b->n = 0;
	for (uint look = 0; look < a->layers.n_looks && b->place != SCENE_NONE; look++) {
		packu counts = 0;

		for (uint y = b->y; y < min(b->y + PLAIN_ROWS, a->request.height); y++)
			counts = max(counts, load_counts(a, look, b->x, y));
		b->n += b->most[look] = most_of(counts);
	}
}

/* Transpose the fragments of a layer from records to rows. Lanes beyond the picture's row repeat its last pixel. */
WIDE_VECTORS static inline void load_layer(const struct plain_arguments *a, struct layer *layer)
{
	__global const float *words = (__global const float *)(a->sparse + layer->from);
	const packu lane = as_uint16(PACK_LANES), place = min(lane, a->width - 1 - layer->at.x) * layer->slots * 6;
	struct pack_list *list = &layer->at.list;
	packf first[4], last[4];

	pack_gather_from(words, place, first);
	pack_gather_from(words, place + 2, last);
	*(pack_loose_uints *)list->item = layer->at.base + lane;
	*(pack_loose_uints *)list->pixel = a->first_pixel + layer->at.y * a->width + layer->at.x + lane;
	*(pack_loose_uints *)list->instance = as_uint16(first[1]);
	*(pack_loose_uints *)list->primitive = as_uint16(first[2]);
	*(pack_loose_floats *)list->b1 = first[3];
	*(pack_loose_floats *)list->b2 = last[2];
	*(pack_loose_floats *)list->depth = last[3];
}

/* Load the layers of row y. row: with its step set. @return not 0 if this step changes any of them */
static inline uint load_layers(const struct plain_arguments *a, const struct layered_block *b, uint y,
                               struct layered_row *row)
{
	const uint n_pixels = a->width * a->request.height;
	uint changed = row->step == PLAIN_FIRST, place = b->place;

	row->n = 0;
	for (uint look = 0; look < a->layers.n_looks && b->n; place += b->most[look++]) {
		const packu counts = load_counts(a, look, b->x, y);
		const uint slots = plain_slots(a->layers.columns, look), n = most_of(counts);

		for (uint i = 0; i < n; i++) {
			struct layer *layer = &row->layers[row->n++];

			layer->look = look;
			layer->at.x = b->x;
			layer->at.y = y;
			layer->at.base = plain_base(place + i, y);
			layer->slots = slots;
			layer->from = (plain_look_first(a->layers.columns, look, n_pixels) + y * a->width + b->x) * slots + i;
			layer->may_leave = a->layers.asking >> look & 1;
			layer->sends_rays = layer->may_leave && a->n_slots;
			layer->there = pack_bits(counts > i);
			layer->placed = layer->drawn = layer->shaded = layer->covered = 0;
			load_layer(a, layer);
			layer->at.dimmed =
				row->step != PLAIN_FIRST && layer->sends_rays ? plain_dimmed(a, layer->at.base, layer->there) : 0;
			layer->leaving =
				row->step != PLAIN_FIRST && a->layers.mirrors ? a->layers.leaving[layer->at.base / PACK_SIZE] : 0;
			changed |= layer->leaving | (row->step == PLAIN_SHADOW ? layer->at.dimmed : 0);
		}
	}
	return changed;
}

/* Initialise what a row of a block sends: no rays to lights, and no fragment that light leaves. */
static inline void send_none(const struct plain_arguments *a, const struct layered_block *b, uint y)
{
	for (uint i = 0; i < b->n && a->layers.mirrors; i++)
		a->layers.leaving[plain_base(b->place + i, y) / PACK_SIZE] = 0;
	for (uint i = 0; i < b->n * a->n_slots; i++)
		for (uint lane = 0; lane < PACK_SIZE; lane++)
			stage_no_ray(&a->rays[i / b->n * a->n + plain_base(b->place + i % b->n, y) + lane]);
}

/* Set all pixels to the clear values. */
WIDE_VECTORS static inline void clear_pixels(__global const struct frame_pixel *cleared, struct layered_row *row)
{
	struct pack_pixels *p = &row->pixels;

	for (int i = 0; i < 3; i++) {
		p->gl[i] = cleared->gl[i];
		p->shadowed[i] = cleared->shadowed[i];
		p->direct[i] = cleared->direct[i];
		p->mirrored[i] = cleared->mirrored[i];
		p->beauty[i] = cleared->beauty[i];
		p->albedo[i] = p->normal[i] = p->position[i] = 0.0f;
	}
	p->gl[3] = cleared->gl[3];
	p->depth = cleared->depth_exact;
	p->drawn = p->id = p->layers = 0.0f;
	row->depth = cleared->depth;
}

/* Values kept for a row's pixels from round to round. */
struct layered_kept_row {
	struct pack_pixels pixels;
	packu depth; /* in the depth buffer's format */
	packu shows; /* bits: 1: a surface is visible; 2: colours from before the frame are, which are not known */
};

#define KEPT_PACKS (sizeof(struct layered_kept_row) / sizeof(packf)) /* PLAIN_KEPT, the numbers stored per pixel */

WIDE_VECTORS static inline void load_kept(__global const float *from, struct layered_kept_row *row)
{
	for (uint i = 0; i < KEPT_PACKS; i++)
		((packf *)row)[i] = ((__global const pack_loose_floats *)from)[i];
}

/* Start the pixels of a row: cleared in the first round, otherwise as the last round left them. */
WIDE_VECTORS static inline void begin_pixels(const struct plain_arguments *a, uint x, uint y, struct layered_row *row)
{
	struct layered_kept_row before;

	row->last = row->surface = SCENE_NONE;
	row->unknown = a->layers.round & PLAIN_UNKNOWN ? (1u << PACK_SIZE) - 1 : 0;
	if (a->layers.round & PLAIN_BEGINS) {
		clear_pixels(a->cleared, row);
		return;
	}
	load_kept(a->layers.before + plain_kept(a->width, x, y), &before);
	row->pixels = before.pixels;
	row->depth = before.depth;
	row->surface -= before.shows & 1; /* SCENE_NONE - 1: there is a surface, but no layer of this round shows it */
	row->unknown = pack_bits((before.shows & 2) != 0);
}

WIDE_VECTORS static inline void store_kept(__global float *to, const struct layered_kept_row *row)
{
	for (uint i = 0; i < KEPT_PACKS; i++)
		((__global pack_loose_floats *)to)[i] = ((const packf *)row)[i];
}

/* Store the pixels of a row for the next round. */
WIDE_VECTORS static inline void keep_pixels(const struct plain_arguments *a, uint x, uint y,
                                            const struct layered_row *row)
{
	struct layered_kept_row after;

	after.pixels = row->pixels;
	after.depth = row->depth;
	after.shows = select((packu)(1), (packu)(0), row->surface == SCENE_NONE) |
	              select((packu)(0), (packu)(2), pack_mask(row->unknown));
	store_kept(a->layers.after + plain_kept(a->width, x, y), &after);
}

/* --- Clears ------------------------------------------------------------------------------------------------------ */

/*
 * Apply the depth clears that precede a look, starting with number `next`. x, y: position of the row.
 * @return the number of the first clear that remains
 */
WIDE_VECTORS static inline uint clear_before(const struct plain_arguments *a, uint look, uint next, uint x, uint y,
                                             struct layered_row *row)
{
	const packi column = as_int16((packu)(x) + as_uint16(PACK_LANES));

	for (; next < a->layers.n_clears && a->layers.clears[next].look <= look; next++) {
		__global const struct layer_clear *c = &a->layers.clears[next];
		const packi lanes = (int)y >= c->y0 && (int)y < c->y1 ? (column >= c->x0) & (column < c->x1) : (packi)(0);

		row->depth = select(row->depth, (packu)(c->depth), lanes);
		pack_put(&row->pixels.depth, (packf)(c->depth_exact), lanes);
	}
	return next;
}

/* --- Tests ------------------------------------------------------------------------------------------------------- */

/*
 * Test fragments of layer i, all of one material, and mark the pixels that they reach (pixel_tests, pixel_mark). Their
 * depths must be known, and their colours if the material tests alpha.
 */
WIDE_VECTORS static inline void test_lanes(const struct plain_arguments *a, struct layered_row *row, uint i,
                                           __global const struct scene_material *m, uint lanes)
{
	const uint bits = pixel_depth_bits(a->bits);
	struct layer *layer = &row->layers[i];
	const packu steps = pixel_depth_steps(layer->depth, bits);
	packi pass = pack_mask(lanes), shows;

	if (m->alpha_test)
		pass &= pixel_compare(m->alpha_func, blend_round(layer->colors.gl.w),
		                      (packu)(blend_round(m->alpha_ref)));
	if (m->depth_test && bits) {
		pass &= pixel_compare(m->depth_func, steps, row->depth);
		if (m->depth_write) {
			row->depth = select(row->depth, steps, pass);
			pack_put(&row->pixels.depth, layer->depth, pass);
		}
	}
	if (!(m->color_mask & 15))
		return;
	layer->drawn |= pack_bits(pass);
	row->last = select(row->last, (packu)(i), pass);
	if (m->blend)
		row->pixels.layers += select((packf)(0), (packf)(1), pass);
	else if ((m->color_mask & 7) == 7)
		pack_put(&row->pixels.layers, (packf)(0), pass);
	shows = !m->blend || m->depth_write ? pass : pass & (row->surface == SCENE_NONE);
	row->surface = select(row->surface, (packu)(i), shows);
}

/* --- Drawing ----------------------------------------------------------------------------------------------------- */

/* Blend one channel of the fragments over the pixels, at one of the steps from GL's colours to the beauty. opaque: 1:
 * replace the pixels' channel */
WIDE_VECTORS static inline void draw_channel(__global const struct scene_material *m, int channel, packf source,
                                             packu s_alpha, packu d_alpha, int opaque, packi lanes, packf *to)
{
	if (m->color_mask >> channel & 1)
		pack_put(to, m->blend && !opaque ? blend_channel(m, channel, source, s_alpha, *to, d_alpha) : source,
		         lanes);
}

/* Test whether channel i has the same value at all steps from GL's colours to the beauty, in the pixels and in the
 * fragments of all given lanes: blending it once is enough then. */
WIDE_VECTORS static inline int is_same(const struct layer *layer, const struct pack_pixels *p, int i, int is_mirrored,
                                       packi lanes)
{
	const packi gl = as_int16(p->gl[i]), own = as_int16(CHANNEL(layer->colors.gl, i));
	packi differ = (gl ^ as_int16(p->shadowed[i])) | (gl ^ as_int16(p->direct[i])) |
	               (own ^ as_int16(CHANNEL(layer->colors.shadowed, i))) |
	               (own ^ as_int16(CHANNEL(layer->colors.direct, i)));

	if (is_mirrored)
		differ |= (gl ^ as_int16(p->mirrored[i])) | (gl ^ as_int16(p->beauty[i])) | (own ^ as_int16(layer->mirrored[i])) |
		          (own ^ as_int16(layer->beauty[i]));
	return !any_pack((differ != 0) & lanes);
}

/* Write the colours of fragments of one material, as pixel_colors does. is_mirrored: as in struct layered_row */
WIDE_VECTORS static inline void draw_lanes(const struct plain_arguments *a, __global const struct scene_material *m,
                                           const struct layer *layer, int is_mirrored, packi lanes,
                                           struct pack_pixels *p)
{
	const struct plain_colors *c = &layer->colors;
	const packu s_alpha = blend_round(c->gl.w),
		    d_alpha = pixel_alpha_bits(a->bits) ? blend_round(p->gl[3]) : (packu)(255);
	const int solid = (m->surface.hidden & SCENE_SOLID) != 0, left_out = (m->surface.hidden & SCENE_LEFT_OUT) != 0;
	const int special = solid | left_out | (is_mirrored && m->surface.transmit > 0.0f);

	for (int i = 0; i < 3; i++) {
		const int same = !special && is_same(layer, p, i, is_mirrored, lanes);

		draw_channel(m, i, CHANNEL(c->gl, i), s_alpha, d_alpha, 0, lanes, &p->gl[i]);
		if (same) {
			pack_put(&p->shadowed[i], p->gl[i], lanes);
			pack_put(&p->direct[i], p->gl[i], lanes);
			pack_put(&p->mirrored[i], p->gl[i], lanes);
			pack_put(&p->beauty[i], p->gl[i], lanes);
			continue;
		}
		draw_channel(m, i, CHANNEL(c->shadowed, i), s_alpha, d_alpha, 0, lanes, &p->shadowed[i]);
		if (left_out)
			continue;
		draw_channel(m, i, CHANNEL(c->direct, i), s_alpha, d_alpha, solid, lanes, &p->direct[i]);
		if (!is_mirrored)
			continue;
		draw_channel(m, i, layer->mirrored[i], s_alpha, d_alpha, solid, lanes, &p->mirrored[i]);
		draw_channel(m, i, layer->beauty[i], s_alpha, d_alpha, solid || m->surface.transmit > 0.0f, lanes, &p->beauty[i]);
	}
	if (!pixel_alpha_bits(a->bits) && m->blend)
		pack_put(&p->gl[3], (packf)(1), m->color_mask & 8 ? lanes : (packi)(0));
	draw_channel(m, 3, c->gl.w, s_alpha, d_alpha, 0, lanes, &p->gl[3]);
}

/* Find the lanes where a fragment leaves nothing of the previous colours, as pixel_replaces does: blended over black,
 * grey and white, it gives the same result. */
WIDE_VECTORS static inline packi replaces(__global const struct scene_material *m, const struct plain_colors *c)
{
	const packu alpha = blend_round(c->gl.w);
	packi same = -1;

	for (int i = 0; i < 3 && m->blend; i++) {
		const packf over = blend_channel(m, i, CHANNEL(c->gl, i), alpha, (packf)(0), (packu)(0));

		same &= over == blend_channel(m, i, CHANNEL(c->gl, i), alpha, (packf)(0.5f), (packu)(128)) &
		        over == blend_channel(m, i, CHANNEL(c->gl, i), alpha, (packf)(1), (packu)(255));
	}
	return (m->color_mask & 7) == 7 ? same : (packi)(0);
}

/* Draw the fragments of a layer that passed the tests and are not covered. */
static inline void draw_layer(const struct plain_arguments *a, const struct layer *layer, struct layered_row *row)
{
	uint material;

	for (uint lanes = layer->drawn & ~layer->covered, same; lanes; lanes &= ~same) {
		same = pack_same_kind(&a->tables, &layer->at.list, lanes, &material);
		same = same ? same : lanes & -lanes;
		if (row->unknown & same)
			row->unknown &= ~(same & pack_bits(replaces(&a->tables.materials[material], &layer->colors)));
		draw_lanes(a, &a->tables.materials[material], layer, row->is_mirrored, pack_mask(same), &row->pixels);
	}
}
