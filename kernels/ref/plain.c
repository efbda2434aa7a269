/* C twins of kernels/frame/plain.cl and layered.cl: a pixel after the other through the steps that frames which are not plain take. */
#include "kernels/frame/plain.h"

#include "kernels/frame/compose.h"
#include "kernels/frame/dome.h"
#include "kernels/gl/program.h"

/* Compose a pixel of the band. */
static void compose_pixel(const struct plain_arguments *a, uint32_t x, uint32_t y, const struct frame_pixel *pixel)
{
	const struct compose_arguments one = {
		.tables = a->tables, .windows = a->windows, .request = a->request, .halves = a->halves, .floats = a->floats,
	};

	compose_one(&one, pixel, 0, (a->request.height - 1 - y) * a->width + x);
}

/* Whether a program has a say in a fragment's colour. */
static int is_by_program(const struct shade_arguments *s, struct fragment f)
{
	const struct geometry *g = &s->tables.geometries[f.instance];

	return stage_is_by_program(s, &s->tables.materials[g->material], g->flags);
}

/* A fragment as fixed function has it. s: as of do_pixel */
static void shade_fixed(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y, uint32_t item)
{
	struct setup_kept kept;

	if (!s->n_slots) {
		a->fragments[item] = plain_fragment(a, x, y);
		a->pixels[item] = a->first_pixel + y * a->width + x;
	}
	shade_item(s, item, 0, &kept);
}

/* s: with visibility where lights have been asked */
static void do_pixel(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y, uint32_t item)
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
		if (!is_by_program(s, f)) /* else plain_program has */
			shade_fixed(a, s, x, y, item);
		for (uint32_t slot = 0; slot < a->n_slots && !s->n_slots; slot++)
			shadow_ray_item(&rays, slot * a->n + item, 0, &shadow_kept);
		if (is_in_dome)
			dome_apply(&a->shaded[item], v3(a->factors[item], a->factors[a->n + item], a->factors[2 * a->n + item]));
		pixel_draw(&a->tables.materials[a->tables.geometries[f.instance].material], &a->shaded[item], &a->fragments[item],
		           stage_draw(&a->tables, f.instance, f.primitive), &pixel, a->bits);
	}
	compose_pixel(a, x, y, &pixel);
}

/* What plain_program leaves for do_pixel. */
static void run_pixel(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y, uint32_t item)
{
	const struct fragment f = plain_fragment(a, x, y);
	struct setup_kept kept;

	if (x >= a->width || y >= a->request.height || f.order == SCENE_NONE || !is_by_program(s, f))
		return;
	shade_fixed(a, s, x, y, item);
	program_item(s, item, 0, &kept);
}

/* What plain_dome leaves for it. */
static void look_from_pixel(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y, uint32_t item)
{
	const struct dome_find_arguments d = {
		.tables = a->tables, .views = a->views, .windows = a->windows, .fragments = a->fragments, .pixels = a->pixels, .width = a->width,
		.shaded = a->shaded, .dome = a->dome, .directions = a->directions, .samples = a->samples, .n = a->n, .places = a->places,
		.rays = a->looks,
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

/* Of the pixels of a block, the most fragments that one has in a look. x, y: a pixel of it */
static uint32_t most_of_block(const struct plain_arguments *a, uint32_t look, uint32_t x, uint32_t y)
{
	const uint32_t *counts = a->counts + plain_look_first(a->columns, look, a->width * a->request.height);
	const uint32_t x0 = x - x % PLAIN_WIDTH, y0 = y - y % PLAIN_ROWS;
	uint32_t most = 0;

	for (y = y0; y < y0 + PLAIN_ROWS && y < a->request.height; y++)
		for (x = x0; x < x0 + PLAIN_WIDTH && x < a->width; x++)
			most = counts[y * a->width + x] > most ? counts[y * a->width + x] : most;
	return most;
}

/* A fragment of a look: its colour, its rays, and through the per-fragment operations. */
static void draw_fragment(const struct plain_arguments *a, const struct shade_arguments *s, struct fragment f, uint32_t number, uint32_t item, int asks,
                          struct frame_pixel *pixel)
{
	const struct shadow_ray_arguments rays = plain_rays(a);
	struct shadow_kept shadow_kept;
	struct setup_kept kept;

	if (!s->n_slots) {
		a->fragments[item] = f;
		a->pixels[item] = a->first_pixel + number;
	}
	if (!s->n_slots || asks)
		shade_item(s, item, 0, &kept);
	for (uint32_t slot = 0; slot < a->n_slots && asks && !s->n_slots; slot++)
		shadow_ray_item(&rays, slot * a->n + item, 0, &shadow_kept);
	pixel_draw(&a->tables.materials[a->tables.geometries[f.instance].material], &a->shaded[item], &a->fragments[item],
	           stage_draw(&a->tables, f.instance, f.primitive), pixel, a->bits);
}

/* do_pixel where there are several looks. item: its place in the block's first layer */
static void draw_layers(const struct plain_arguments *a, const struct shade_arguments *s, uint32_t x, uint32_t y, uint32_t item)
{
	const int is_there = x < a->width && y < a->request.height;
	const uint32_t number = y * a->width + x;
	struct frame_pixel pixel = *a->cleared;

	for (uint32_t look = 0; look < a->n_looks && item != SCENE_NONE; look++) {
		const uint32_t first = plain_look_first(a->columns, look, a->width * a->request.height) + number, slots = plain_slots(a->columns, look);
		const uint32_t most = most_of_block(a, look, x, y), n = is_there ? a->counts[first] : 0;

		for (uint32_t i = 0; i < most; i++, item += PLAIN_WIDTH * PLAIN_ROWS) {
			for (uint32_t slot = 0; slot < a->n_slots && !s->n_slots; slot++)
				stage_no_ray(&a->rays[slot * a->n + item]);
			if (i < n)
				draw_fragment(a, s, a->sparse[first * slots + i], number, item, a->asking >> look & 1, &pixel);
		}
	}
	if (is_there)
		compose_pixel(a, x, y, &pixel);
}

/* Each pixel of blocks first .. last-1 by one of those above. */
static void do_blocks(const struct plain_arguments *a, uint32_t n_slots, size_t first, size_t last,
                      void (*one)(const struct plain_arguments *, const struct shade_arguments *, uint32_t, uint32_t, uint32_t))
{
	const struct shade_arguments s = plain_shading(a, n_slots);
	const uint32_t columns = plain_columns(a->width);

	for (size_t block = first; block < last && block < plain_blocks(a->width, a->request.height); block++)
		for (uint32_t i = 0; i < PLAIN_WIDTH * PLAIN_ROWS; i++) {
			const uint32_t x = (uint32_t)block % columns * PLAIN_WIDTH + i % PLAIN_WIDTH;
			const uint32_t y = (uint32_t)block / columns * PLAIN_ROWS + i / PLAIN_WIDTH, base = plain_base(a->blocks[block], y);

			one(a, &s, x, y, base == SCENE_NONE ? base : base + i % PLAIN_WIDTH);
		}
}

void plain_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, 0, first, last, do_pixel);
}

void plain_shadow_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, a->n_slots, first, last, do_pixel);
}

void layered_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, 0, first, last, draw_layers);
}

void layered_shadow_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, a->n_slots, first, last, draw_layers);
}

void plain_program_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, a->n_slots, first, last, run_pixel);
}

void plain_dome_c(const struct plain_arguments *a, size_t first, size_t last)
{
	do_blocks(a, 0, first, last, look_from_pixel);
}
