/*
 * plain_color, plain_ask, plain_show, plain_color_dimmed, plain_show_dimmed: see kernels/frame/plain/plain.h. One pixel
 * per work item, for devices that run many work items in lockstep.
 *
 * A single kernel for all of plain needs as many registers as its most demanding part: 134 on an H200, where the two
 * kernels took 0.69 and 0.28 ms for a frame of the hall, compared with 0.51 and 0.28 ms for the split ones, including
 * four launches with a wait after each.
 */
#include "kernels/frame/stages/compose.h"
#include "kernels/frame/plain/plain.h"

/* A pixel's position in the band, and its number, which is the index of its stored data. */
struct plain_spot {
	uint x, y, item;
};

static inline struct plain_spot spot_of(const struct plain_arguments *a, uint item)
{
	struct plain_spot at;

	at.x = plain_x(a->width, item);
	at.y = plain_y(a->width, item);
	at.item = item;
	return at;
}

/* --- From a fragment to the planes ------------------------------------------------------------------------------- */

/* A colour without mirrors. */
static inline void put_colors(struct compose_pixel *p, __global const float *gl, __global const float *shadowed,
                              __global const float *direct)
{
	for (uint c = 0; c < 3; c++) {
		p->display[COLOR_GL + c] = gl[c];
		p->display[COLOR_SHADOWED + c] = shadowed[c];
		p->display[COLOR_DIRECT + c] = p->display[COLOR_MIRRORED + c] = p->display[COLOR_BEAUTY + c] = direct[c];
	}
	p->halves[COMPOSE_GL + 3] = gl[3];
}

static inline void put_place(struct compose_pixel *p, struct vec3 normal, struct vec3 position)
{
	p->halves[COMPOSE_NORMAL] = normal.x;
	p->halves[COMPOSE_NORMAL + 1] = normal.y;
	p->halves[COMPOSE_NORMAL + 2] = normal.z;
	p->floats[COMPOSE_Z] = -position.z;
	p->floats[COMPOSE_POSITION] = position.x;
	p->floats[COMPOSE_POSITION + 1] = position.y;
	p->floats[COMPOSE_POSITION + 2] = position.z;
}

static inline void put_cleared(__global const struct frame_pixel *cleared, struct compose_pixel *p)
{
	put_colors(p, cleared->gl, cleared->shadowed, cleared->direct);
	put_place(p, v3(0, 0, 0), v3(0, 0, 0));
	for (uint c = 0; c < 3; c++)
		p->display[COLOR_ALBEDO + c] = 0;
	p->halves[COMPOSE_BEAUTY + 3] = 0;
	p->floats[COMPOSE_DEPTH] = cleared->depth_exact;
	p->floats[COMPOSE_ID] = p->floats[COMPOSE_LAYERS] = 0;
}

static inline void put_fragment(const struct plain_arguments *a, const struct fragment *f,
                                __global const struct shaded *s, struct compose_pixel *p)
{
	struct vec3 normal, position;

	put_colors(p, s->gl, s->shadowed, s->direct);
	compose_surface(&a->tables, a->windows, f, &normal, &position);
	put_place(p, normal, position);
	for (uint c = 0; c < 3; c++)
		p->display[COLOR_ALBEDO + c] = s->albedo[c];
	p->halves[COMPOSE_BEAUTY + 3] = 1;
	p->floats[COMPOSE_DEPTH] = s->depth;
	p->floats[COMPOSE_ID] = (float)stage_draw(&a->tables, f->instance, f->primitive);
}

/* Test whether a shaded fragment is in front of the clear depth. */
static inline int shows(const struct plain_arguments *a, const struct fragment *f, __global const struct shaded *s)
{
	const uint steps = pixel_depth_steps(s->depth, pixel_depth_bits(a->bits));

	return s->flags & SHADED_THERE &&
	       pixel_compare(stage_material(&a->tables, f->instance)->depth_func, steps, a->cleared->depth);
}

static inline void compose_pixel(const struct plain_arguments *a, const struct plain_spot *at, int is_there)
{
	struct compose_pixel p;

	put_cleared(a->cleared, &p);
	if (is_there) {
		const struct fragment f = a->fragments[at->item];

		if (shows(a, &f, &a->shaded[at->item]))
			put_fragment(a, &f, &a->shaded[at->item], &p);
	}
	compose_colors(&p, &a->request);
	compose_store(&p, &a->request, compose_at(&a->request, at->y * a->width + at->x), a->halves, a->floats);
}

/* --- Kernels ----------------------------------------------------------------------------------------------------- */

KERNEL_OF(float4) void plain_color(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, 0);
	const struct plain_spot at = spot_of(&a, (uint)get_global_id(0));
	struct setup_kept kept;

	if (get_global_id(0) >= n || !plain_has_fragment(&a, at.x, at.y))
		return;
	a.fragments[at.item] = plain_fragment(&a, at.x, at.y);
	a.pixels[at.item] = a.first_pixel + at.y * a.width + at.x;
	shade_item(&s, at.item, 0, &kept);
}

KERNEL_OF(float4) void plain_ask(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shadow_ray_arguments to = plain_rays(&a);
	const uint item = (uint)get_global_id(0);
	const struct plain_spot at = spot_of(&a, item % n);
	struct shadow_kept kept;

	if (item >= to.n_rays)
		return;
	if (plain_has_fragment(&a, at.x, at.y))
		shadow_ray_item(&to, item, 0, &kept);
	else
		stage_no_ray(&a.rays[item]);
}

KERNEL_OF(float4) void plain_show(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct plain_spot at = spot_of(&a, (uint)get_global_id(0));

	if (get_global_id(0) < n && !plain_is_outside(&a, at.x, at.y))
		compose_pixel(&a, &at, plain_has_fragment(&a, at.x, at.y));
}

KERNEL_OF(float4) void plain_color_dimmed(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, n_slots);
	const struct plain_spot at = spot_of(&a, (uint)get_global_id(0));
	struct setup_kept kept;

	if (get_global_id(0) < n && plain_is_dimmed(&a, at.x, at.y, at.item))
		shade_item(&s, at.item, 0, &kept);
}

KERNEL_OF(float4) void plain_show_dimmed(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct plain_spot at = spot_of(&a, (uint)get_global_id(0));

	if (get_global_id(0) < n && plain_is_dimmed(&a, at.x, at.y, at.item))
		compose_pixel(&a, &at, 1);
}
