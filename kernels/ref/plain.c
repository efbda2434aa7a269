/* C twins of kernels/frame/plain/plain.cl, plain_single.cl and layered.cl: each pixel in turn goes through the steps of
 * frames that are not plain. */
#include "kernels/frame/plain/plain.h"

#include <string.h>

#include "kernels/frame/stages/compose.h"
#include "kernels/frame/dome/dome.h"
#include "kernels/gl/program.h"

/* Compose a pixel of the band. */
static void compose_pixel(const struct plain_arguments *a, uint32_t x, uint32_t y, const struct frame_pixel *pixel)
{
	const struct compose_arguments one = {
		.tables = a->tables, .windows = a->windows, .request = a->request, .halves = a->halves, .floats = a->floats,
	};

	compose_one(&one, pixel, 0, (a->request.height - 1 - y) * a->width + x);
}

/* Test whether a program affects a fragment's colour. */
static int is_by_program(const struct shade_arguments *s, struct fragment f)
{
	const struct geometry *g = &s->tables.geometries[f.instance];

	return stage_is_by_program(s, &s->tables.materials[g->material], g->flags);
}

/* A fragment shaded by fixed function. s: as in do_pixel */
static void shade_fixed(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y,
                        uint32_t item)
{
	struct setup_kept kept;

	if (!s->n_slots) {
		a->fragments[item] = plain_fragment(a, x, y);
		a->pixels[item] = a->first_pixel + y * a->width + x;
	}
	shade_item(s, item, 0, &kept);
}

/* Draw a shaded fragment to its pixel. */
static void draw_pixel(const struct plain_arguments *a, uint32_t x, uint32_t y, uint32_t item,
                       struct frame_pixel *pixel)
{
	const struct fragment f = plain_fragment(a, x, y);

	pixel_draw(&a->tables.materials[a->tables.geometries[f.instance].material], &a->shaded[item], &a->fragments[item],
	           stage_draw(&a->tables, f.instance, f.primitive), pixel, a->bits);
}

/* s: with visibility once lights have been queried */
static void do_pixel(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y,
                     uint32_t item)
{
	const struct shadow_ray_arguments rays = plain_rays(a);
	const struct fragment f = plain_fragment(a, x, y);
	const int is_in_dome = a->dome.reach > 0;
	struct frame_pixel pixel = *a->cleared;
	struct shadow_kept shadow_kept;

	for (uint32_t slot = 0; slot < a->n_slots && !s->n_slots && item != SCENE_NONE; slot++)
		stage_no_ray(&a->rays[slot * a->n + item]);
	if (x >= a->width || y >= a->request.height || (s->n_slots && f.order == SCENE_NONE && !is_in_dome))
		return;
	if (f.order != SCENE_NONE) {
		if (!is_by_program(s, f)) /* otherwise plain_program has shaded it */
			shade_fixed(a, s, x, y, item);
		for (uint32_t slot = 0; slot < a->n_slots && !s->n_slots; slot++)
			shadow_ray_item(&rays, slot * a->n + item, 0, &shadow_kept);
		if (is_in_dome)
			dome_apply(&a->shaded[item], v3(a->factors[item], a->factors[a->n + item], a->factors[2 * a->n + item]));
		draw_pixel(a, x, y, item, &pixel);
	}
	compose_pixel(a, x, y, &pixel);
}

/* Computes what plain_program leaves for do_pixel. */
static void run_pixel(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y,
                      uint32_t item)
{
	const struct fragment f = plain_fragment(a, x, y);
	struct setup_kept kept;

	if (x >= a->width || y >= a->request.height || f.order == SCENE_NONE || !is_by_program(s, f))
		return;
	shade_fixed(a, s, x, y, item);
	program_item(s, item, 0, &kept);
}

/* Computes what plain_dome leaves for do_pixel. */
static void look_from_pixel(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y,
                            uint32_t item)
{
	const struct dome_find_arguments d = {
		.tables = a->tables, .views = a->views, .windows = a->windows, .fragments = a->fragments, .pixels = a->pixels,
		.width = a->width, .shaded = a->shaded, .dome = a->dome, .directions = a->directions, .samples = a->samples,
		.n = a->n, .places = a->places, .rays = a->looks,
	};
	const struct shadow_ray_arguments rays = plain_rays(a);
	struct shadow_kept kept;

	if (item == SCENE_NONE)
		return;
	dome_find_none(&d, item);
	for (uint32_t slot = 0; slot < a->n_slots; slot++)
		stage_no_ray(&a->rays[slot * a->n + item]);
	if (x >= a->width || y >= a->request.height || plain_fragment(a, x, y).order == SCENE_NONE)
		return;
	shade_fixed(a, s, x, y, item);
	for (uint32_t slot = 0; slot < a->n_slots; slot++)
		shadow_ray_item(&rays, slot * a->n + item, 0, &kept);
	dome_find_item(&d, item);
}

/* The largest number of fragments of any pixel of a block in a look. x, y: a pixel of the block */
static uint32_t most_of_block(const struct plain_arguments *a, uint32_t look, uint32_t x, uint32_t y)
{
	const uint32_t *counts = a->layers.counts + plain_look_first(a->layers.columns, look, a->width * a->request.height);
	const uint32_t x0 = x - x % PLAIN_WIDTH, y0 = y - y % PLAIN_ROWS;
	uint32_t most = 0;

	for (y = y0; y < y0 + PLAIN_ROWS && y < a->request.height; y++)
		for (x = x0; x < x0 + PLAIN_WIDTH && x < a->width; x++)
			most = counts[y * a->width + x] > most ? counts[y * a->width + x] : most;
	return most;
}

/* Index in the list of a fragment that light leaves; SCENE_NONE: light does not leave it. */
static uint32_t place_in_list(const struct plain_arguments *a, uint32_t item)
{
	const uint32_t leaving = a->layers.mirrors ? a->layers.leaving[item / PLAIN_WIDTH] : 0;
	uint32_t place;

	if (!(leaving >> item % PLAIN_WIDTH & 1))
		return SCENE_NONE;
	place = a->layers.list_first[item / PLAIN_WIDTH];
	for (uint32_t i = 0; i < item % PLAIN_WIDTH; i++)
		place += leaving >> i & 1;
	return place;
}

/* Add a shaded fragment to that list, or take from it what its paths found. */
static void follow(const struct plain_arguments *a, uint32_t step, uint32_t item)
{
	const uint32_t place = step == PLAIN_FIRST ? SCENE_NONE : place_in_list(a, item);

	if (place == SCENE_NONE)
		return;
	if (step == PLAIN_MIRROR) {
		v3_store(a->shaded[item].mirrored, v3_load(a->layers.list_shaded[place].mirrored));
		v3_store(a->shaded[item].beauty, v3_load(a->layers.list_shaded[place].beauty));
		return;
	}
	a->layers.list[place] = a->fragments[item];
	a->layers.list_pixels[place] = a->pixels[item];
	a->layers.list_shaded[place] = a->shaded[item];
}

/* Draw a fragment of a look: its colour, its rays, and the per-fragment operations. */
static void draw_fragment(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t step,
                          uint32_t item, int asks, struct frame_pixel *pixel)
{
	const struct shadow_ray_arguments rays = plain_rays(a);
	const struct fragment *f = &a->fragments[item];
	const struct scene_material *m = &a->tables.materials[a->tables.geometries[f->instance].material];
	struct shadow_kept shadow_kept;
	struct setup_kept kept;

	if (step == PLAIN_FIRST || asks)
		shade_item(s, item, 0, &kept);
	for (uint32_t slot = 0; slot < a->n_slots && asks && step == PLAIN_FIRST; slot++)
		shadow_ray_item(&rays, slot * a->n + item, 0, &shadow_kept);
	follow(a, step, item);
	pixel_draw(m, &a->shaded[item], f, stage_draw(&a->tables, f->instance, f->primitive), pixel, a->bits);
	if (step == PLAIN_FIRST && a->layers.mirrors && asks && a->shaded[item].flags & SHADED_DRAWN &&
	    (m->surface.reflect > 0 || m->surface.transmit > 0))
		a->layers.leaving[item / PLAIN_WIDTH] |= 1u << item % PLAIN_WIDTH;
}

/* A pixel as the last round left it, or with the clear values. */
static struct frame_pixel begin_pixel(const struct plain_arguments *a, uint32_t x, uint32_t y)
{
	struct frame_pixel pixel = *a->cleared;

	if (a->layers.round & PLAIN_UNKNOWN)
		pixel.unknown = PIXEL_UNKNOWN_COLOR;
	if (!(a->layers.round & PLAIN_BEGINS))
		memcpy(&pixel, a->layers.before + plain_kept(a->width, 0, y) + x * PLAIN_KEPT, sizeof(pixel));
	return pixel;
}

/* Keep a pixel for the next round, or compose it and record whether its colour is known. */
static void end_pixel(const struct plain_arguments *a, uint32_t x, uint32_t y, const struct frame_pixel *pixel)
{
	uint32_t *unknown = &a->layers.unknown[y * plain_columns(a->width) + x / PLAIN_WIDTH];

	if (!(a->layers.round & PLAIN_ENDS)) {
		memcpy(a->layers.after + plain_kept(a->width, 0, y) + x * PLAIN_KEPT, pixel, sizeof(*pixel));
		return;
	}
	compose_pixel(a, x, y, pixel);
	*unknown = (x % PLAIN_WIDTH ? *unknown : 0) | (pixel->unknown & PIXEL_UNKNOWN_COLOR) << x % PLAIN_WIDTH;
}

_Static_assert(sizeof(struct frame_pixel) == PLAIN_KEPT * sizeof(float), "PLAIN_KEPT floats hold a pixel");

/*
 * Apply the depth clears before a look, starting with number `next`. @return the number of the first clear that remains
 */
static uint32_t clear_before(const struct plain_arguments *a, uint32_t look, uint32_t next, uint32_t x, uint32_t y,
                             struct frame_pixel *pixel)
{
	for (; next < a->layers.n_clears && a->layers.clears[next].look <= look; next++) {
		const struct layer_clear *c = &a->layers.clears[next];

		if ((int32_t)x < c->x0 || (int32_t)x >= c->x1 || (int32_t)y < c->y0 || (int32_t)y >= c->y1)
			continue;
		pixel->depth = c->depth;
		pixel->depth_exact = c->depth_exact;
	}
	return next;
}

/* do_pixel for several looks. item: its place in the block's first layer */
static void draw_layers(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t step, uint32_t x,
                        uint32_t y, uint32_t item)
{
	const int is_there = x < a->width && y < a->request.height;
	const uint32_t number = y * a->width + x;
	struct frame_pixel pixel;
	uint32_t clear = 0;

	if (is_there)
		pixel = begin_pixel(a, x, y);
	for (uint32_t look = 0; look < a->layers.n_looks && item != SCENE_NONE; look++) {
		const uint32_t first = plain_look_first(a->layers.columns, look, a->width * a->request.height) + number;
		const uint32_t slots = plain_slots(a->layers.columns, look), most = most_of_block(a, look, x, y);

		if (is_there)
			clear = clear_before(a, look, clear, x, y, &pixel);
		for (uint32_t i = 0; i < most; i++, item += PLAIN_WIDTH * PLAIN_ROWS) {
			for (uint32_t slot = 0; slot < a->n_slots && step == PLAIN_FIRST; slot++)
				stage_no_ray(&a->rays[slot * a->n + item]);
			if (step == PLAIN_FIRST && a->layers.mirrors && item % PLAIN_WIDTH == 0)
				a->layers.leaving[item / PLAIN_WIDTH] = 0;
			if (!is_there || i >= a->layers.counts[first])
				continue;
			if (step == PLAIN_FIRST) {
				a->fragments[item] = a->sparse[first * slots + i];
				a->pixels[item] = a->first_pixel + number;
			}
			draw_fragment(a, s, step, item, a->layers.asking >> look & 1, &pixel);
		}
	}
	if (!is_there)
		return;
	clear_before(a, SCENE_NONE, clear, x, y, &pixel);
	end_pixel(a, x, y, &pixel);
}

static void draw_layers_first(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y,
                              uint32_t item)
{
	draw_layers(a, s, PLAIN_FIRST, x, y, item);
}

static void draw_layers_shadow(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y,
                               uint32_t item)
{
	draw_layers(a, s, PLAIN_SHADOW, x, y, item);
}

static void draw_layers_mirror(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y,
                               uint32_t item)
{
	draw_layers(a, s, PLAIN_MIRROR, x, y, item);
}

/* The separate steps of do_pixel, for fragments without programs. */
static void color_pixel(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y,
                        uint32_t item)
{
	if (plain_has_fragment(a, x, y))
		shade_fixed(a, s, x, y, item);
}

static void show_pixel(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y,
                       uint32_t item)
{
	struct frame_pixel pixel = *a->cleared;

	if (plain_is_outside(a, x, y) || (s->n_slots && !plain_is_dimmed(a, x, y, item)))
		return;
	if (plain_has_fragment(a, x, y))
		draw_pixel(a, x, y, item, &pixel);
	compose_pixel(a, x, y, &pixel);
}

typedef void one_pixel(const struct plain_arguments *, const struct shade_arguments *, uint32_t, uint32_t, uint32_t);

/* Process each pixel of blocks first .. last-1 with one of the functions above. */
static void do_blocks(const struct plain_arguments *a, uint32_t n_slots, size_t first, size_t last, one_pixel *one)
{
	const struct shade_arguments s = plain_shading(a, n_slots);

	for (size_t block = first; block < last && block < plain_blocks(a->width, a->request.height); block++)
		for (uint32_t i = 0; i < PLAIN_WIDTH * PLAIN_ROWS; i++) {
			const uint32_t number = (uint32_t)block * PLAIN_WIDTH * PLAIN_ROWS + i, y = plain_y(a->width, number);
			const uint32_t base = plain_base(a->blocks[block], y);

			one(a, &s, plain_x(a->width, number), y, base == SCENE_NONE ? base : base + i % PLAIN_WIDTH);
		}
}

/* Process pixels first .. last-1 with one of the steps; a pixel's place is its number. */
static void do_pixels(const struct plain_arguments *a, uint32_t n_slots, size_t first, size_t last, one_pixel *one)
{
	const struct shade_arguments s = plain_shading(a, n_slots);

	for (size_t item = first; item < last && item < a->n; item++)
		one(a, &s, plain_x(a->width, (uint32_t)item), plain_y(a->width, (uint32_t)item), (uint32_t)item);
}

void plain_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, 0, first, last, do_pixel);
}

void plain_shadow_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, a->n_slots, first, last, do_pixel);
}

void plain_color_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_pixels(a, 0, first, last, color_pixel);
}

void plain_ask_c(const struct plain_arguments *a, size_t first, size_t last)
{
	const struct shadow_ray_arguments rays = plain_rays(a);
	struct shadow_kept kept;

	for (size_t item = first; item < last && item < rays.n_rays; item++) {
		const uint32_t number = (uint32_t)item % a->n;

		if (plain_has_fragment(a, plain_x(a->width, number), plain_y(a->width, number)))
			shadow_ray_item(&rays, (uint32_t)item, 0, &kept);
		else
			stage_no_ray(&a->rays[item]);
	}
}

void plain_show_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_pixels(a, 0, first, last, show_pixel);
}

void plain_color_dimmed_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_pixels(a, a->n_slots, first, last, color_pixel);
}

void plain_show_dimmed_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_pixels(a, a->n_slots, first, last, show_pixel);
}

/* Convert a pixel from GL's frame buffer. */
static struct frame_pixel start_pixel(const struct layered_start_arguments *a, uint32_t i)
{
	struct frame_pixel p = { .id = 0 };
	float gl[4];

	for (int c = 0; c < 4; c++)
		gl[c] = (float)(a->colors[i] >> 8 * c & 255) / 255.0f;
	pixel_start(&p, gl, a->depths[i], a->bits);
	return p;
}

void layered_start_c(const struct layered_start_arguments *a, size_t first, size_t last)
{
	for (size_t item = first; item < last && item < (size_t)plain_columns(a->width) * a->height; item++) {
		const uint32_t x = (uint32_t)item % plain_columns(a->width) * PLAIN_WIDTH,
			       y = (uint32_t)item / plain_columns(a->width);

		for (uint32_t i = x; i < x + PLAIN_WIDTH && i < a->width; i++) {
			const struct frame_pixel p = start_pixel(a, y * a->width + i);

			memcpy(a->kept + plain_kept(a->width, 0, y) + i * PLAIN_KEPT, &p, sizeof(p));
		}
	}
}

/* A pixel, rounded as in GL's frame buffer. @return 1: its colour is not known */
static uint32_t picture_pixel(const struct layered_picture_arguments *a, uint32_t x, uint32_t y)
{
	const uint32_t i = y * a->width + x;
	struct frame_pixel p;

	memcpy(&p, a->kept + plain_kept(a->width, 0, y) + x * PLAIN_KEPT, sizeof(p));
	a->colors[i] = pixel_alpha_bits(a->bits) ? blend_round(p.gl[3]) << 24 : 0xff000000u;
	for (uint32_t c = 0; c < 3; c++)
		a->colors[i] |= blend_round(p.gl[c]) << 8 * c;
	a->depths[i] = pixel_depth_bits(a->bits) > 24 ? p.depth >> 8 : p.depth;
	return (p.unknown & PIXEL_UNKNOWN_COLOR) != 0;
}

void layered_picture_c(const struct layered_picture_arguments *a, size_t first, size_t last)
{
	for (size_t item = first; item < last && item < (size_t)plain_columns(a->width) * a->height; item++) {
		const uint32_t x = (uint32_t)item % plain_columns(a->width) * PLAIN_WIDTH,
			       y = (uint32_t)item / plain_columns(a->width);

		a->unknown[item] = 0;
		for (uint32_t i = 0; i < PLAIN_WIDTH && x + i < a->width; i++)
			a->unknown[item] |= picture_pixel(a, x + i, y) << i;
	}
}

void layered_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, 0, first, last, draw_layers_first);
}

void layered_shadow_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, a->n_slots, first, last, draw_layers_shadow);
}

void layered_mirror_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, a->n_slots, first, last, draw_layers_mirror);
}

void plain_program_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, a->n_slots, first, last, run_pixel);
}

void plain_dome_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, 0, first, last, look_from_pixel);
}

/* The intersection of two rectangles; it may be empty. */
static struct camera_rectangle both_of(struct camera_rectangle a, struct camera_rectangle b)
{
	struct camera_rectangle r = { a.x0 > b.x0 ? a.x0 : b.x0, a.y0 > b.y0 ? a.y0 : b.y0, a.x1 < b.x1 ? a.x1 : b.x1,
		                      a.y1 < b.y1 ? a.y1 : b.y1 };

	if (r.x1 < r.x0 || r.y1 < r.y0)
		r = (struct camera_rectangle){ 0, 0, 0, 0 };
	return r;
}

void plain_whole_c(const struct plain_whole_arguments *a, size_t first, size_t last)
{
	const int32_t low = (int32_t)(a->pass.first_pixel / a->pass.width), width = (int32_t)a->pass.width;
	const struct camera_rectangle r = a->pass.rectangle, band = { 0, low, width, low + (int32_t)a->request.height };
	const struct plain_arguments p = {
		.tables = a->tables, .views = a->pass.views, .windows = a->pass.window, .sparse = a->pass.fragments,
		.rectangle = { r.x0, r.y0 - low, r.x1, r.y1 - low }, .width = a->pass.width, .height = a->pass.height,
		.first_pixel = a->pass.first_pixel, .bits = a->bits, .cleared = a->cleared, .request = a->request,
		.n = a->pass.width * a->request.height, .fragments = a->alone, .pixels = a->pixels, .shaded = a->shaded,
		.halves = a->halves, .floats = a->floats,
	};
	const struct shade_arguments s = plain_shading(&p, 0);

	for (size_t item = first; item < last && item < camera_packet_items(band); item++) {
		const int32_t x = camera_packet_x(band, (uint32_t)item), y = camera_packet_y(band, (uint32_t)item);
		const struct camera_rectangle tile = both_of(
			band, (struct camera_rectangle){ x, y, x + CAMERA_TILE, y + CAMERA_TILE });
		struct camera_packet_arguments camera = { a->pass, a->instances, a->top, a->instance_list, a->nodes, a->triangles };

		camera.pass.rectangle = both_of(tile, r);
		camera_packet_c(&camera, 0, camera_packet_items(camera.pass.rectangle));
		for (int32_t row = tile.y0 - low; row < tile.y1 - low; row++)
			for (int32_t column = tile.x0; column < tile.x1; column++)
				do_pixel(&p, &s, (uint32_t)column, (uint32_t)row, (uint32_t)(row * width + column));
	}
}
