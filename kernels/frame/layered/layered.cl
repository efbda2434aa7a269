/*
 * layered, layered_shadow, layered_mirror, layered_start, layered_picture: see kernels/frame/plain/plain.h. All
 * fragments of a row of sixteen pixels go through the per-fragment operations in draw order, layer by layer: the first
 * fragment of each pixel, then the second of each, and so on.
 *
 * Depth tests come before colours, and colours are computed from the last layer to the first, so a fragment that fails
 * or that a later one covers completely is not shaded and sends no rays. Rows with fragments that light leaves are
 * composed by layered_mirror alone. If nothing in the previous row was covered, layers are drawn as they are tested.
 */
#include "kernels/frame/layered/layer.h"

/* Results that the next fragments of a block may reuse. */
struct layered_kept {
	struct pack_encoded encoded;
	struct pack_kept pack;
	struct setup_kept one;
	struct shadow_kept ray;
};

/* --- Colours ----------------------------------------------------------------------------------------------------- */

/* Write the albedo, normals and positions of the fragments of layer i that kept->last has placed. */
static inline void put_layer_surface(const struct plain_arguments *a, struct layered_row *row, uint i, uint lanes,
                                     const struct pack_surface *s, const struct pack_kept *kept)
{
	const packi shows = pack_mask(lanes) & (row->surface == i);

	if (a->request.half_plane[COMPOSE_ALBEDO] != SCENE_NONE)
		for (int c = 0; c < 3; c++)
			pack_put(&row->pixels.albedo[c], CHANNEL(row->layers[i].colors.albedo, c), shows);
	if (pack_wants_surface(&a->request))
		pack_put_surface(&a->tables, &kept->last, s, shows, &row->pixels);
}

/* Locate fragments of one material in their triangles, for kept->last. @return the lanes that are done */
static inline uint place_lanes(const struct plain_arguments *a, const struct shade_arguments *s, struct layer *layer,
                               uint lanes, struct pack_kept *kept)
{
	__global const struct geometry *g = &a->tables.geometries[layer->at.list.instance[popcount((lanes & -lanes) - 1)]];

	kept->last.material = &a->tables.materials[g->material];
	kept->last.view = &a->views[g->view];
	lanes = pack_place(s, &layer->at.list, lanes, 1, kept, &kept->last);
	if (lanes)
		pack_put(&layer->depth, kept->last.depth, pack_mask(lanes));
	return lanes;
}

/* Copy the colours of some lanes. */
WIDE_VECTORS static inline void keep_colors(const struct plain_colors *from, packi lanes, struct plain_colors *to)
{
	for (int i = 0; i < 4; i++)
		pack_put(&CHANNEL(to->gl, i), CHANNEL(from->gl, i), lanes);
	for (int i = 0; i < 3; i++) {
		pack_put(&CHANNEL(to->shadowed, i), CHANNEL(from->shadowed, i), lanes);
		pack_put(&CHANNEL(to->direct, i), CHANNEL(from->direct, i), lanes);
		pack_put(&CHANNEL(to->albedo, i), CHANNEL(from->albedo, i), lanes);
	}
}

/* --- Light that leaves ------------------------------------------------------------------------------------------- */

/* Index in the list of a fragment that light leaves. */
static inline uint place_in_list(const struct plain_arguments *a, const struct layer *layer, uint lane)
{
	return a->layers.list_first[layer->at.base / PACK_SIZE] + popcount(layer->leaving & ((1u << lane) - 1));
}

/* Add a fragment that light leaves to the list. f, direct: as it was shaded. */
static inline void list_one(const struct plain_arguments *a, const struct layer *layer, uint lane, struct fragment f,
                            struct vec3 direct)
{
	const uint place = place_in_list(a, layer, lane);
	__global struct shaded *to = &a->layers.list_shaded[place];

	a->layers.list[place] = f;
	a->layers.list_pixels[place] = layer->at.list.pixel[lane];
	stage_store_direct(to, direct);
	to->flags = SHADED_THERE;
}

/* Take the colours of a fragment that light leaves, with the light that its paths found. */
static inline void take_one(const struct plain_arguments *a, struct layer *layer, uint lane)
{
	__global const struct shaded *from = &a->layers.list_shaded[place_in_list(a, layer, lane)];

	for (uint c = 0; c < 3; c++) {
		LANE(layer->mirrored[c], float, lane) = from->mirrored[c];
		LANE(layer->beauty[c], float, lane) = from->beauty[c];
	}
}

/* List the fragments that light leaves or, in step PLAIN_MIRROR, take their colours. p: kept->last, which has placed
 * them. They are shaded */
static inline void follow_lanes(const struct plain_arguments *a, const struct layered_row *row, struct layer *layer,
                                uint lanes, const struct pack *p)
{
	const struct pack_list *list = &layer->at.list;

	for (int c = 0; c < 3 && row->is_mirrored; c++) {
		pack_put(&layer->mirrored[c], CHANNEL(layer->colors.direct, c), pack_mask(lanes));
		pack_put(&layer->beauty[c], CHANNEL(layer->colors.direct, c), pack_mask(lanes));
	}
	for (uint left = lanes & layer->leaving; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);
		const struct vec4_16 *direct = &layer->colors.direct;
		struct fragment f;

		if (row->step == PLAIN_MIRROR) {
			take_one(a, layer, lane);
			continue;
		}
		f.order = 0;
		f.instance = list->instance[lane];
		f.primitive = list->primitive[lane];
		f.b1 = LANE(p->b1, const float, lane);
		f.b2 = LANE(p->b2, const float, lane);
		f.depth = LANE(p->depth, const float, lane);
		list_one(a, layer, lane, f, v3(LANE(direct->x, const float, lane), LANE(direct->y, const float, lane),
		                               LANE(direct->z, const float, lane)));
	}
}

/* Find the visible fragments of a row that light leaves. @return not 0 if there are any */
static inline uint find_leaving(const struct plain_arguments *a, struct layered_row *row)
{
	uint all = 0;

	for (uint i = 0; i < row->n && a->layers.mirrors; i++) {
		struct layer *layer = &row->layers[i];

		for (uint left = row->step == PLAIN_FIRST && layer->may_leave ? layer->drawn & ~layer->covered : 0; left;
		     left &= left - 1) {
			__global const struct scene_material *m = stage_material(
				&a->tables, layer->at.list.instance[popcount((left & -left) - 1)]);

			if (m->surface.reflect > 0.0f || m->surface.transmit > 0.0f)
				layer->leaving |= left & -left;
		}
		if (row->step == PLAIN_FIRST)
			a->layers.leaving[layer->at.base / PACK_SIZE] = layer->leaving;
		all |= layer->leaving;
	}
	return all;
}

/* --- Fragments --------------------------------------------------------------------------------------------------- */

/*
 * Shade fragments of one material in layer i; send their rays to lights.
 * @param tests  1: they have not been tested yet
 * @return the lanes that are done
 */
static inline uint shade_layer_lanes(const struct plain_arguments *a, const struct shade_arguments *s,
                                     struct layered_row *row, uint i, uint lanes, int tests, struct pack_kept *kept)
{
	struct layer *layer = &row->layers[i];
	const int sends = layer->sends_rays && row->step == PLAIN_FIRST;
	struct plain_colors colors;
	struct pack_surface surface;
	packu lights;
	uint left;

	if (lanes & ~layer->placed)
		lanes = place_lanes(a, s, layer, lanes, kept);
	else if (!row->at_once)
		kept->last = layer->pack;
	if (!lanes)
		return 0;
	plain_shade(a, s, &layer->at, lanes, kept, &lights, &colors);
	if (colors.is_gl)
		colors.shadowed = colors.direct = colors.gl;
	keep_colors(&colors, pack_mask(lanes), &layer->colors);
	layer->shaded |= lanes;
	follow_lanes(a, row, layer, lanes, &kept->last);
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

/* Shade and test a fragment that packs cannot handle. */
static inline void shade_layer_alone(const struct plain_arguments *a, const struct shade_arguments *s,
                                     struct layered_row *row, uint i, uint lane, struct layered_kept *kept)
{
	struct layer *layer = &row->layers[i];
	const uint item = layer->at.base + lane;
	__global const struct shaded *shaded = &a->shaded[item];
	const struct shadow_ray_arguments r = plain_rays(a);
	struct fragment f;

	if (row->step == PLAIN_FIRST) {
		a->fragments[item] = a->sparse[layer->from + lane * layer->slots];
		a->pixels[item] = layer->at.list.pixel[lane];
	}
	if (row->step == PLAIN_FIRST || layer->sends_rays)
		shade_item(s, item, 0, &kept->one);
	for (uint slot = 0; slot < a->n_slots && layer->sends_rays && row->step == PLAIN_FIRST; slot++)
		shadow_ray_item(&r, slot * a->n + item, 0, &kept->ray);
	if (!(shaded->flags & SHADED_THERE) || shaded->flags & SHADED_STENCIL)
		return;
	for (uint c = 0; c < 3; c++) {
		LANE(CHANNEL(layer->colors.gl, c), float, lane) = shaded->gl[c];
		LANE(CHANNEL(layer->colors.shadowed, c), float, lane) = shaded->shadowed[c];
		LANE(CHANNEL(layer->colors.direct, c), float, lane) = shaded->direct[c];
		LANE(layer->mirrored[c], float, lane) = LANE(layer->beauty[c], float, lane) = shaded->direct[c];
	}
	LANE(layer->colors.gl.w, float, lane) = shaded->gl[3];
	LANE(layer->depth, float, lane) = shaded->depth;
	layer->shaded |= 1u << lane;
	f = a->fragments[item];
	if (layer->leaving >> lane & 1 && row->step == PLAIN_SHADOW)
		list_one(a, layer, lane, f, v3_load(shaded->direct));
	if (layer->leaving >> lane & 1 && row->step == PLAIN_MIRROR)
		take_one(a, layer, lane);
	test_lanes(a, row, i, stage_material(&a->tables, f.instance), 1u << lane);
	if (LANE(row->surface, uint, lane) != i)
		return;
	for (uint c = 0; c < 3; c++)
		LANE(row->pixels.albedo[c], float, lane) = shaded->albedo[c];
	pack_put_one(&a->tables, a->windows, &f, lane, &row->pixels);
}

/* --- Rows -------------------------------------------------------------------------------------------------------- */

/* Test layer i. If the result depends on colours, or nothing can cover the fragments, they are shaded at once. */
static inline void test_layer(const struct plain_arguments *a, const struct shade_arguments *s, struct layered_row *row,
                              uint i, struct layered_kept *kept)
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
			if (done && row->at_once) {
				layer->placed = done;
				if (layer->drawn & done)
					shade_layer_lanes(a, s, row, i, layer->drawn & done, 0, &kept->pack);
			} else if (done && !layer->placed) {
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

/*
 * Shade layer i where it is visible. covered: lanes covered by later layers. @return these, plus the lanes that this
 * layer covers
 */
static inline uint shade_layer(const struct plain_arguments *a, const struct shade_arguments *s,
                               struct layered_row *row, uint i, uint covered, struct layered_kept *kept)
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
		case 2: covers |= same & pack_bits(blend_round(layer->colors.gl.w) == 255); break;
		default: break;
		}
	}
	return covered | covers;
}

/* The lanes of a row of sixteen pixels that lie within the picture. */
static inline uint lanes_there(uint x, uint width)
{
	return width - x < PLAIN_WIDTH ? (1u << (width - x)) - 1 : 0xffffu;
}

/* Write the draw numbers of the fragments drawn last. */
static inline void put_draws(const struct plain_arguments *a, struct layered_row *row)
{
	const packi drawn = row->last != SCENE_NONE;

	pack_put(&row->pixels.drawn, (packf)(1), drawn);
	for (uint lanes = a->request.float_plane[COMPOSE_ID] != SCENE_NONE ? pack_bits(drawn) : 0; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);
		const struct pack_list *list = &row->layers[LANE(row->last, const uint, lane)].at.list;

		LANE(row->pixels.id, float, lane) = (float)stage_draw(&a->tables, list->instance[lane], list->primitive[lane]);
	}
}

/* Write a row to the planes or to the next round. Rows that light leaves are only written in the step that knows what
 * their paths found. */
static inline void draw_row(const struct plain_arguments *a, const struct shade_arguments *s, uint x, uint y,
                            struct layered_row *row, struct layered_kept *kept, const struct pack_planes *to)
{
	uint covered = 0, spared = 0, clear = 0;

	begin_pixels(a, x, y, row);
	for (uint i = 0; i < row->n; i++) {
		clear = clear_before(a, row->layers[i].look, clear, x, y, row);
		test_layer(a, s, row, i, kept);
		if (row->at_once)
			draw_layer(a, &row->layers[i], row);
	}
	clear_before(a, SCENE_NONE, clear, x, y, row);
	for (uint i = row->at_once ? 0 : row->n; i-- > 0 && row->n > 1;) {
		covered = shade_layer(a, s, row, i, covered, kept);
		spared |= row->layers[i].drawn & ~row->layers[i].shaded;
	}
	if (find_leaving(a, row) && row->step != PLAIN_MIRROR)
		return;
	for (uint i = 0; i < row->n && !row->at_once; i++)
		draw_layer(a, &row->layers[i], row);
	row->at_once |= !spared && row->n > 1 && !a->layers.mirrors;
	put_draws(a, row);
	for (int i = 0; i < 3 && !row->is_mirrored; i++)
		row->pixels.mirrored[i] = row->pixels.beauty[i] = row->pixels.direct[i];
	if (!(a->layers.round & PLAIN_ENDS)) {
		keep_pixels(a, x, y, row);
		return;
	}
	pack_compose(&row->pixels, 0, to, &kept->encoded);
	a->layers.unknown[y * plain_columns(a->width) + x / PLAIN_WIDTH] = row->unknown & lanes_there(x, a->width);
}

/* Process a block in one of the three steps. s: with visibility once lights have been queried */
static inline void do_layered_block(const struct plain_arguments *a, const struct shade_arguments *s, uint step,
                                    uint item)
{
	struct layered_kept kept;
	struct layered_row row;
	struct layered_block b;
	uint empty = SCENE_NONE; /* index in the planes of a row without fragments */

	load_block(a, item, &b);
	pack_keep_nothing(&kept.pack);
	kept.encoded.known = 0;
	row.step = step;
	row.at_once = 0;
	row.is_mirrored = step == PLAIN_MIRROR || (a->layers.round & PLAIN_MIRRORED) != 0;
	for (uint y = b.y; y < b.y + PLAIN_ROWS; y++) {
		struct pack_planes to;

		if (step == PLAIN_FIRST)
			send_none(a, &b, y);
		if (y >= a->request.height || !load_layers(a, &b, y, &row))
			continue;
		to = pack_planes_of(&a->request, a->halves, a->floats, b.x, y);
		if (!row.n && empty != SCENE_NONE) {
			pack_compose_again(empty, &to);
			continue;
		}
		draw_row(a, s, b.x, y, &row, &kept, &to);
		if (!row.n && to.n == PACK_SIZE && !a->layers.n_clears &&
		    (a->layers.round & (PLAIN_BEGINS | PLAIN_ENDS | PLAIN_UNKNOWN)) == (PLAIN_BEGINS | PLAIN_ENDS))
			empty = to.at;
	}
}

/* One word per pixel of a row; lanes beyond its end repeat the last pixel. */
static inline packu load_words(__global const uint *row, uint x, uint width)
{
	packu words;

	if (x + PLAIN_WIDTH <= width)
		return *(__global const pack_loose_uints *)&row[x];
	for (uint lane = 0; lane < PACK_SIZE; lane++)
		LANE(words, uint, lane) = row[min(x + lane, width - 1)];
	return words;
}

/* Convert a row's pixels from GL's frame buffer. */
WIDE_VECTORS static inline void keep_start(packu color, packu depth, uint depth_bits, struct layered_kept_row *to)
{
	struct pack_pixels *p = &to->pixels;
	const uint far = pixel_bits_mask(depth_bits);

	for (uint c = 0; c < 4; c++)
		p->gl[c] = convert_float16(as_int16(color >> 8 * c & 255)) / 255.0f;
	for (uint c = 0; c < 3; c++) {
		p->shadowed[c] = p->direct[c] = p->mirrored[c] = p->beauty[c] = p->gl[c];
		p->albedo[c] = p->normal[c] = p->position[c] = 0;
	}
	to->depth = depth_bits > 24 ? depth << 8 | depth >> 16 : depth;
	p->depth = far ? convert_float16(to->depth) / (float)far : 1;
	p->drawn = 1;
	p->id = p->layers = 0;
	to->shows = 0;
}

KERNEL_OF(float16) void layered_start(KERNEL_ARGUMENTS(layered_start))
{
	const uint item = (uint)get_global_id(0), x = item % plain_columns(width) * PLAIN_WIDTH,
		   y = item / plain_columns(width);
	struct layered_kept_row row;

	if (y >= height)
		return;
	keep_start(load_words(colors + y * width, x, width), load_words(depths + y * width, x, width),
	           pixel_depth_bits(bits), &row);
	store_kept(kept + plain_kept(width, x, y), &row);
}

/* A row's pixels, rounded as in GL's frame buffer. */
WIDE_VECTORS static inline packu frame_colors(const struct pack_pixels *p, uint alpha_bits)
{
	const packu alpha = alpha_bits ? blend_round(p->gl[3]) : (packu)(255);

	return blend_round(p->gl[0]) | blend_round(p->gl[1]) << 8 | blend_round(p->gl[2]) << 16 | alpha << 24;
}

KERNEL_OF(float16) void layered_picture(KERNEL_ARGUMENTS(layered_picture))
{
	const uint item = (uint)get_global_id(0), x = item % plain_columns(width) * PLAIN_WIDTH,
		   y = item / plain_columns(width);
	struct layered_kept_row row;
	packu code, depth;

	if (y >= height)
		return;
	load_kept(kept + plain_kept(width, x, y), &row);
	code = frame_colors(&row.pixels, pixel_alpha_bits(bits));
	depth = pixel_depth_bits(bits) > 24 ? row.depth >> 8 : row.depth;
	unknown[item] = pack_bits((row.shows & 2) != 0) & lanes_there(x, width);
	if (x + PLAIN_WIDTH <= width) {
		*(__global pack_loose_uints *)&colors[y * width + x] = code;
		*(__global pack_loose_uints *)&depths[y * width + x] = depth;
		return;
	}
	for (uint lane = 0; lane < width - x; lane++) {
		colors[y * width + x + lane] = LANE(code, const uint, lane);
		depths[y * width + x + lane] = LANE(depth, const uint, lane);
	}
}

KERNEL_OF(float16) void layered(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, 0);

	if ((uint)get_global_id(0) < plain_blocks(width, request.height))
		do_layered_block(&a, &s, PLAIN_FIRST, (uint)get_global_id(0));
}

KERNEL_OF(float16) void layered_shadow(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, n_slots);

	if ((uint)get_global_id(0) < plain_blocks(width, request.height))
		do_layered_block(&a, &s, PLAIN_SHADOW, (uint)get_global_id(0));
}

KERNEL_OF(float16) void layered_mirror(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, n_slots);

	if ((uint)get_global_id(0) < plain_blocks(width, request.height))
		do_layered_block(&a, &s, PLAIN_MIRROR, (uint)get_global_id(0));
}
