/*
 * layered, layered_shadow: see kernels/frame/plain.h. All fragments of a row of sixteen pixels go through the per-fragment operations in draw
 * order, layer by layer: the first of each pixel, the second of each, and so on. Depth tests come before colours, and colours are found from
 * the last layer to the first: a fragment that fails, or that a later one covers whole, is not shaded, and sends no rays.
 */
#include "kernels/frame/pack_blend.h"
#include "kernels/frame/plain_row.h"

/* One fragment of each pixel. Lanes a bit each. */
struct layer {
	struct plain_row at;
	struct plain_colors colors; /* of those that are shaded */
	packf depth;
	struct pack pack;                   /* of those in `placed`, of one material */
	uint there, placed, drawn, shaded, covered; /* drawn: all tests passed; covered: by a later one */
	uint from, slots;                   /* of the first pixel's fragment in a->sparse; how far the next one's is from it */
	int asks;                           /* lights, of those that are drawn */
};

/* A row of sixteen pixels on its way. */
struct layered_row {
	struct layer layers[PLAIN_LAYERS];
	struct pack_pixels pixels;
	packu depth;         /* as the depth buffer has it */
	packu last, surface; /* the layers of the last fragment that was drawn, and of the one whose surface shows; SCENE_NONE: there is none */
	uint n;
};

/* What is kept from one fragment to the next. */
struct layered_kept {
	struct pack_kept pack;
	struct setup_kept one;
	struct shadow_kept ray;
};

/* --- Loading ------------------------------------------------------------------------------------------------------- */

/* How many fragments each pixel of a row has in a look. */
static inline packu load_counts(const struct plain_arguments *a, uint look, uint x, uint y)
{
	__global const uint *counts = a->counts + plain_look_first(a->columns, look, a->width * a->request.height) + y * a->width + x;
	packu n = 0;

	if (x + PACK_SIZE <= a->width)
		return *(__global const pack_loose_uints *)counts;
	for (uint lane = 0; lane < a->width - x; lane++)
		LANE(n, uint, lane) = counts[lane];
	return n;
}

static inline uint most_of(packu n)
{
	uint most = 0;

	for (uint lane = 0; lane < PACK_SIZE; lane++)
		most = max(most, LANE(n, uint, lane));
	return most;
}

/* Where the layers of a block lie. */
struct layered_block {
	uint x, y; /* its first pixel */
	uint place, most[PLAIN_LOOKS], n; /* of its first layer; how many a look has; all of them */
};

static inline void load_block(const struct plain_arguments *a, uint item, struct layered_block *b)
{
	b->x = item % plain_columns(a->width) * PLAIN_WIDTH;
	b->y = item / plain_columns(a->width) * PLAIN_ROWS;
	b->place = a->blocks[item];
	b->n = 0;
	for (uint look = 0; look < a->n_looks && b->place != SCENE_NONE; look++) {
		packu counts = 0;

		for (uint y = b->y; y < min(b->y + PLAIN_ROWS, a->request.height); y++)
			counts = max(counts, load_counts(a, look, b->x, y));
		b->n += b->most[look] = most_of(counts);
	}
}

/* Fragments of a layer, from records to rows. Lanes beyond the picture's row repeat its last pixel. */
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

/* The layers of a row. n_slots: of lights whose visibility is there. @return whether any fragment is dimmed */
static inline uint load_layers(const struct plain_arguments *a, uint n_slots, const struct layered_block *b, uint y, struct layered_row *row)
{
	const uint n_pixels = a->width * a->request.height;
	uint dimmed = 0, place = b->place;

	row->n = 0;
	for (uint look = 0; look < a->n_looks && b->n; place += b->most[look++]) {
		const packu counts = load_counts(a, look, b->x, y);
		const uint slots = plain_slots(a->columns, look), n = most_of(counts);

		for (uint i = 0; i < n; i++) {
			struct layer *layer = &row->layers[row->n++];

			layer->at.x = b->x;
			layer->at.y = y;
			layer->at.base = plain_base(place + i, y);
			layer->slots = slots;
			layer->from = (plain_look_first(a->columns, look, n_pixels) + y * a->width + b->x) * slots + i;
			layer->asks = a->n_slots && a->asking >> look & 1;
			layer->there = pack_bits(counts > i);
			layer->placed = layer->drawn = layer->shaded = layer->covered = 0;
			load_layer(a, layer);
			layer->at.dimmed = n_slots && layer->asks ? plain_dimmed(a, layer->at.base, layer->there) : 0;
			dimmed |= layer->at.dimmed;
		}
	}
	return dimmed;
}

/* Where the rays of a block's row lie, there are none so far. */
static inline void send_none(const struct plain_arguments *a, const struct layered_block *b, uint y)
{
	for (uint i = 0; i < b->n * a->n_slots; i++)
		for (uint lane = 0; lane < PACK_SIZE; lane++)
			stage_no_ray(&a->rays[i / b->n * a->n + plain_base(b->place + i % b->n, y) + lane]);
}

/* All pixels as they were cleared. */
WIDE_VECTORS static inline void clear_pixels(__global const struct frame_pixel *cleared, struct layered_row *row)
{
	struct pack_pixels *p = &row->pixels;

	for (int i = 0; i < 3; i++) {
		p->gl[i] = cleared->gl[i];
		p->shadowed[i] = cleared->shadowed[i];
		p->direct[i] = cleared->direct[i];
		p->albedo[i] = p->normal[i] = p->position[i] = 0.0f;
	}
	p->gl[3] = cleared->gl[3];
	p->depth = cleared->depth_exact;
	p->drawn = p->id = p->layers = 0.0f;
	row->depth = cleared->depth;
	row->last = row->surface = SCENE_NONE;
}

/* --- Tests --------------------------------------------------------------------------------------------------------- */

/* As pixel_tests and pixel_mark: fragments of layer i, of one material, whose depths are known, and colours where it tests alpha. */
WIDE_VECTORS static inline void test_lanes(const struct plain_arguments *a, struct layered_row *row, uint i, __global const struct scene_material *m,
                                           uint lanes)
{
	const uint bits = pixel_depth_bits(a->bits);
	struct layer *layer = &row->layers[i];
	const packu steps = pack_depth_steps(layer->depth, bits);
	packi pass = pack_mask(lanes), shows;

	if (m->alpha_test)
		pass &= pack_compare(m->alpha_func, pack_code(layer->colors.gl.c[3]), (packu)(blend_round(m->alpha_ref)));
	if (m->depth_test && bits) {
		pass &= pack_compare(m->depth_func, steps, row->depth);
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

/* --- Colours ------------------------------------------------------------------------------------------------------- */

/* What shows of fragments of layer i that kept->last has placed beside their colours. */
static inline void put_layer_surface(const struct plain_arguments *a, struct layered_row *row, uint i, uint lanes, const struct pack_surface *s,
                               const struct pack_kept *kept)
{
	const packi shows = pack_mask(lanes) & (row->surface == i);

	if (a->request.half_plane[COMPOSE_ALBEDO] != SCENE_NONE)
		for (int c = 0; c < 3; c++)
			pack_put(&row->pixels.albedo[c], row->layers[i].colors.albedo.c[c], shows);
	if (pack_wants_surface(&a->request))
		pack_put_surface(&a->tables, &kept->last, s, shows, &row->pixels);
}

/* Places of fragments of one material, into kept->last. @return those that are done */
static inline uint place_lanes(const struct plain_arguments *a, const struct shade_arguments *s, struct layer *layer, uint lanes,
                               struct pack_kept *kept)
{
	__global const struct geometry *g = &a->tables.geometries[layer->at.list.instance[popcount((lanes & -lanes) - 1)]];

	kept->last.material = &a->tables.materials[g->material];
	kept->last.view = &a->views[g->view];
	lanes = pack_place(s, &layer->at.list, lanes, 1, kept, &kept->last);
	if (lanes)
		pack_put(&layer->depth, kept->last.depth, pack_mask(lanes));
	return lanes;
}

WIDE_VECTORS static inline void keep_colors(const struct plain_colors *from, packi lanes, struct plain_colors *to)
{
	for (int i = 0; i < 4; i++)
		pack_put(&to->gl.c[i], from->gl.c[i], lanes);
	for (int i = 0; i < 3; i++) {
		pack_put(&to->shadowed.c[i], from->shadowed.c[i], lanes);
		pack_put(&to->direct.c[i], from->direct.c[i], lanes);
		pack_put(&to->albedo.c[i], from->albedo.c[i], lanes);
	}
}

/* Colours of fragments of one material in layer i. tests: they have not been tested yet. @return those that are done */
static inline uint shade_layer_lanes(const struct plain_arguments *a, const struct shade_arguments *s, struct layered_row *row, uint i, uint lanes,
                               int tests, struct pack_kept *kept)
{
	struct layer *layer = &row->layers[i];
	const int sends = layer->asks && !s->n_slots;
	struct plain_colors colors;
	struct pack_surface surface;
	packu lights;
	uint left;

	if (lanes & ~layer->placed)
		lanes = place_lanes(a, s, layer, lanes, kept);
	else
		kept->last = layer->pack;
	if (!lanes)
		return 0;
	plain_shade(a, s, &layer->at, lanes, kept, &lights, &colors);
	keep_colors(&colors, pack_mask(lanes), &layer->colors);
	layer->shaded |= lanes;
	if (tests)
		test_lanes(a, row, i, kept->last.material, lanes);
	left = lanes & layer->drawn;
	if (!left)
		return lanes;
	if (pack_wants_surface(&a->request) || sends)
		pack_surface(&a->tables, &kept->last, &surface);
	put_layer_surface(a, row, i, left, &surface, kept);
	if (sends)
		plain_send_rays(a, &layer->at, &kept->last, &surface, lights, left);
	return lanes;
}

/* A fragment that packs do not know, all that is to be done of it. */
static inline void shade_layer_alone(const struct plain_arguments *a, const struct shade_arguments *s, struct layered_row *row, uint i, uint lane,
                             struct layered_kept *kept)
{
	struct layer *layer = &row->layers[i];
	const uint item = layer->at.base + lane;
	__global const struct shaded *shaded = &a->shaded[item];
	const struct shadow_ray_arguments r = plain_rays(a);
	struct fragment f;

	if (!s->n_slots) {
		a->fragments[item] = a->sparse[layer->from + lane * layer->slots];
		a->pixels[item] = layer->at.list.pixel[lane];
	}
	if (!s->n_slots || layer->asks)
		shade_item(s, item, 0, &kept->one);
	for (uint slot = 0; slot < a->n_slots && layer->asks && !s->n_slots; slot++)
		shadow_ray_item(&r, slot * a->n + item, 0, &kept->ray);
	if (!(shaded->flags & SHADED_THERE))
		return;
	for (uint c = 0; c < 3; c++) {
		LANE(layer->colors.gl.c[c], float, lane) = shaded->gl[c];
		LANE(layer->colors.shadowed.c[c], float, lane) = shaded->shadowed[c];
		LANE(layer->colors.direct.c[c], float, lane) = shaded->direct[c];
	}
	LANE(layer->colors.gl.c[3], float, lane) = shaded->gl[3];
	LANE(layer->depth, float, lane) = shaded->depth;
	layer->shaded |= 1u << lane;
	f = a->fragments[item];
	test_lanes(a, row, i, stage_material(&a->tables, f.instance), 1u << lane);
	if (LANE(row->surface, uint, lane) != i)
		return;
	for (uint c = 0; c < 3; c++)
		LANE(row->pixels.albedo[c], float, lane) = shaded->albedo[c];
	pack_put_one(&a->tables, a->windows, &f, lane, &row->pixels);
}

/* --- Rows ---------------------------------------------------------------------------------------------------------- */

/* Tests of layer i. Where the outcome needs colours, or nothing can cover them, fragments are shaded at once. */
static inline void test_layer(const struct plain_arguments *a, const struct shade_arguments *s, struct layered_row *row, uint i,
                              struct layered_kept *kept)
{
	struct layer *layer = &row->layers[i];
	uint material;

	for (uint lanes = layer->there; lanes;) {
		const uint bit = lanes & -lanes, same = pack_same_kind(&a->tables, &layer->at.list, lanes, &material);
		__global const struct scene_material *m = &a->tables.materials[material];
		uint done = 0;

		if (same & bit && plain_knows(s, m) && (m->alpha_test || row->n == 1)) {
			done = shade_layer_lanes(a, s, row, i, same, 1, &kept->pack);
		} else if (same & bit && plain_knows(s, m)) {
			done = place_lanes(a, s, layer, same, &kept->pack);
			if (done)
				test_lanes(a, row, i, m, done);
			if (done && !layer->placed) {
				layer->pack = kept->pack.last;
				layer->placed = done;
			}
		}
		if (!(done & bit)) {
			shade_layer_alone(a, s, row, i, popcount(bit - 1), kept);
			done |= bit;
		}
		lanes &= ~done;
	}
}

/* Colours of layer i, where they can be seen. covered: by later layers. @return with what this one covers */
static inline uint shade_layer(const struct plain_arguments *a, const struct shade_arguments *s, struct layered_row *row, uint i, uint covered,
                               struct layered_kept *kept)
{
	struct layer *layer = &row->layers[i];
	uint material, covers = 0;

	layer->covered = covered;
	for (uint lanes = layer->drawn & (~covered | pack_bits(row->surface == i)), same; lanes; lanes &= ~same) {
		__global const struct scene_material *m;

		same = pack_same_kind(&a->tables, &layer->at.list, lanes, &material);
		same = same ? same : lanes & -lanes;
		m = &a->tables.materials[material];
		if (same & ~layer->shaded)
			shade_layer_lanes(a, s, row, i, same & ~layer->shaded, 0, &kept->pack);
		switch (pack_covers(m)) {
		case 1: covers |= same; break;
		case 2: covers |= same & pack_bits(pack_code(layer->colors.gl.c[3]) == 255); break;
		default: break;
		}
	}
	return covered | covers;
}

/* One channel of a part of the colours over the same part of the pixels. */
WIDE_VECTORS static inline void draw_channel(__global const struct scene_material *m, int channel, packf source, packu s_alpha, packu d_alpha, int opaque,
                                             packi lanes, packf *to)
{
	if (m->color_mask >> channel & 1)
		pack_put(to, m->blend && !opaque ? pack_blend(m, channel, source, s_alpha, *to, d_alpha) : source, lanes);
}

/* As pixel_colors, for fragments of one material. Where no light is dimmed all parts are the same. */
WIDE_VECTORS static inline void draw_lanes(const struct plain_arguments *a, __global const struct scene_material *m, const struct plain_colors *c,
                                           packi lanes, struct pack_pixels *p)
{
	const packu s_alpha = pack_code(c->gl.c[3]), d_alpha = pixel_alpha_bits(a->bits) ? pack_code(p->gl[3]) : (packu)(255);
	const int solid = (m->surface.hidden & SCENE_SOLID) != 0, left_out = (m->surface.hidden & SCENE_LEFT_OUT) != 0;

	for (int i = 0; i < 3; i++) {
		const packi gl = as_int16(p->gl[i]), own = as_int16(c->gl.c[i]);
		const packi differ = (gl ^ as_int16(p->shadowed[i])) | (gl ^ as_int16(p->direct[i])) | (own ^ as_int16(c->shadowed.c[i])) |
		                     (own ^ as_int16(c->direct.c[i]));
		const int same = !solid && !left_out && !any_pack((differ != 0) & lanes);

		draw_channel(m, i, c->gl.c[i], s_alpha, d_alpha, 0, lanes, &p->gl[i]);
		if (same) {
			pack_put(&p->shadowed[i], p->gl[i], lanes);
			pack_put(&p->direct[i], p->gl[i], lanes);
			continue;
		}
		draw_channel(m, i, c->shadowed.c[i], s_alpha, d_alpha, 0, lanes, &p->shadowed[i]);
		if (!left_out)
			draw_channel(m, i, c->direct.c[i], s_alpha, d_alpha, solid, lanes, &p->direct[i]);
	}
	if (m->color_mask & 8)
		pack_put(&p->gl[3], m->blend ? pack_blend(m, 3, c->gl.c[3], s_alpha, convert_float16(as_int16(d_alpha)) / 255.0f, d_alpha) : c->gl.c[3], lanes);
}

static inline void draw_layer(const struct plain_arguments *a, const struct layer *layer, struct pack_pixels *p)
{
	uint material;

	for (uint lanes = layer->drawn & ~layer->covered, same; lanes; lanes &= ~same) {
		same = pack_same_kind(&a->tables, &layer->at.list, lanes, &material);
		same = same ? same : lanes & -lanes;
		draw_lanes(a, &a->tables.materials[material], &layer->colors, pack_mask(same), p);
	}
}

/* Which draws pixels show. */
static inline void put_draws(const struct plain_arguments *a, struct layered_row *row)
{
	const packi drawn = row->last != SCENE_NONE;

	row->pixels.drawn = select((packf)(0), (packf)(1), drawn);
	for (uint lanes = a->request.float_plane[COMPOSE_ID] != SCENE_NONE ? pack_bits(drawn) : 0; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);
		const struct pack_list *list = &row->layers[LANE(row->last, const uint, lane)].at.list;

		LANE(row->pixels.id, float, lane) = (float)stage_draw(&a->tables, list->instance[lane], list->primitive[lane]);
	}
}

/* From layers to planes. */
static inline void draw_row(const struct plain_arguments *a, const struct shade_arguments *s, struct layered_row *row, struct layered_kept *kept,
                            const struct pack_planes *to)
{
	uint covered = 0;

	clear_pixels(a->cleared, row);
	for (uint i = 0; i < row->n; i++)
		test_layer(a, s, row, i, kept);
	for (uint i = row->n; i-- > 0 && row->n > 1;)
		covered = shade_layer(a, s, row, i, covered, kept);
	for (uint i = 0; i < row->n; i++)
		draw_layer(a, &row->layers[i], &row->pixels);
	put_draws(a, row);
	for (int i = 0; i < 3; i++)
		row->pixels.mirrored[i] = row->pixels.beauty[i] = row->pixels.direct[i];
	pack_compose(&row->pixels, to);
}

/* s: with visibility where lights have been asked */
static inline void do_layered_block(const struct plain_arguments *a, const struct shade_arguments *s, uint item)
{
	struct layered_kept kept;
	struct layered_row row;
	struct layered_block b;
	uint empty = SCENE_NONE; /* where a row without fragments stands in the planes */

	load_block(a, item, &b);
	pack_keep_nothing(&kept.pack);
	for (uint y = b.y; y < b.y + PLAIN_ROWS; y++) {
		struct pack_planes to;

		if (!s->n_slots)
			send_none(a, &b, y);
		if (y >= a->request.height || (!load_layers(a, s->n_slots, &b, y, &row) && s->n_slots))
			continue;
		to = pack_planes_of(&a->request, a->halves, a->floats, b.x, y);
		if (!row.n && empty != SCENE_NONE) {
			pack_compose_again(empty, &to);
			continue;
		}
		draw_row(a, s, &row, &kept, &to);
		if (!row.n && to.n == PACK_SIZE)
			empty = to.at;
	}
}

KERNEL_OF(float16) void layered(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, 0);

	if ((uint)get_global_id(0) < plain_blocks(width, request.height))
		do_layered_block(&a, &s, (uint)get_global_id(0));
}

KERNEL_OF(float16) void layered_shadow(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, n_slots);

	if ((uint)get_global_id(0) < plain_blocks(width, request.height))
		do_layered_block(&a, &s, (uint)get_global_id(0));
}
