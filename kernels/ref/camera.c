/*
 * C twins of camera_packet, camera_wide and camera_compressed: one pixel at a time, as specified in
 * kernels/camera/camera.h.
 */
#include "kernels/camera/camera.h"

#include <math.h>

#include "kernels/rays/compressed.h"
#include "kernels/gl/clip.h"
#include "kernels/kernels.h"
#include "kernels/rays/rays.h"

/* Arguments that the three kernels share. */
struct args {
	const struct view *view;
	uint32_t width, height, mode, first_pixel;
	struct camera_rectangle rectangle;
	const struct instance *instances;
	const struct node2 *top;
	const uint32_t *instance_list;
	/* The trees of one type and their triangles; the other types are NULL. */
	const struct node2 *nodes;
	const struct triangle *triangles; /* for compressed trees, too */
	const struct node8c *compressed;
	const struct node8 *rows;
	const struct face8 *faces;
	const struct window_vertex *window;
	const float (*clip)[4];
	const uint32_t *after;
	struct fragment *fragments;
	uint32_t *counts;
};

/* State of a pixel: its ray in eye space, and its fragments. */
struct pixel {
	const struct args *args;
	int32_t x, y;
	float o[3], d[3]; /* point(t) = o + t d; t = 0 is the near plane */
	float d_scale; /* factor that d was divided by */
	float near_w, far_w; /* w of the unprojected near and far points */
	float t_max;
	uint32_t best_depth; /* NEAREST: in steps of 2^-24 */
	struct fragment *fragments;
	uint32_t count;
};

/* All arguments except the trees and their triangles. */
#define COMMON_ARGS(a) \
	.view = (a)->pass.views + (a)->pass.view_index, .width = (a)->pass.width, .height = (a)->pass.height, \
	.mode = (a)->pass.mode, \
	.rectangle = (a)->pass.rectangle, .first_pixel = (a)->pass.first_pixel, \
	.instances = (a)->instances, .top = (a)->top, .instance_list = (a)->instance_list, .window = (a)->pass.window, \
	.clip = (const float (*)[4])(a)->pass.clip, .after = (a)->pass.after, .fragments = (a)->pass.fragments, \
	.counts = (a)->pass.counts

/* Index of a pixel in the buffers. */
static size_t place_of(const struct args *args, int32_t x, int32_t y)
{
	return (uint32_t)y * args->width + (uint32_t)x - args->first_pixel;
}

/* --- fragments --------------------------------------------------------------------------------------------------- */

static uint32_t quantise_depth(float depth)
{
	return (uint32_t)rintf(depth * 16777215.0f);
}

/*
 * End the ray behind depth d. Let u be the share of the depth range, N the near point and F the far point (homogeneous:
 * N + l F sweeps the ray, with l = u / (1 - u) at share u). Then t = u / (N_w ((1 - u) N_w + u F_w)), in units of F N_w
 * - N F_w. A small margin is added for rounding and for equal depths.
 */
static void shorten(struct pixel *p, float depth)
{
	const float near = p->args->view->depth_range[0], range = p->args->view->depth_range[1] - near;
	float u, w;

	if (!(range > 0))
		return; /* the nearest depth is not the first along the ray */
	u = (depth - near) / range + 4e-7f;
	w = (1.0f - u) * p->near_w + u * p->far_w;
	w -= 1e-6f * p->near_w;
	if (w * p->near_w > 0)
		p->t_max = fminf(p->t_max, u * p->d_scale / (p->near_w * w));
}

static void keep_nearest(struct pixel *p, const struct fragment *f)
{
	const uint32_t depth = quantise_depth(f->depth);
	const struct fragment *best = &p->fragments[0];

	if (p->count) {
		if (depth > p->best_depth)
			return;
		if (depth == p->best_depth &&
		    (p->args->mode == CAMERA_NEAREST_LESS ? f->order > best->order : f->order < best->order))
			return;
	}
	p->fragments[0] = *f;
	p->best_depth = depth;
	p->count = 1;
	shorten(p, f->depth);
}

static void keep_in_column(struct pixel *p, const struct fragment *f)
{
	uint32_t place = p->count;

	if (f->order < p->args->after[place_of(p->args, p->x, p->y)])
		return;
	while (place > 0 && p->fragments[place - 1].order > f->order)
		place--;
	/* A triangle may be in several leaves. */
	if (place == CAMERA_COLUMN_MAX || (place > 0 && p->fragments[place - 1].order == f->order))
		return;
	if (p->count < CAMERA_COLUMN_MAX)
		p->count++;
	for (uint32_t i = p->count - 1; i > place; i--)
		p->fragments[i] = p->fragments[i - 1];
	p->fragments[place] = *f;
}

static void keep(struct pixel *p, const struct fragment *f)
{
	if (p->args->mode == CAMERA_COLUMN)
		keep_in_column(p, f);
	else
		keep_nearest(p, f);
}

/* --- coverage ---------------------------------------------------------------------------------------------------- */

/* Twice the signed area, in 1/65536 square pixels, of the triangle a, b and the sample position: positive to the left
 * of a -> b. */
static int64_t edge(struct window_vertex a, struct window_vertex b, const struct pixel *p)
{
	const struct clip_spot at = clip_spot(p->args->view, p->x, p->y);

	return ((int64_t)b.x - a.x) * (at.y - a.y) - ((int64_t)b.y - a.y) * (at.x - a.x);
}

/*
 * 1 if centres on the edge a -> b of a counter-clockwise triangle belong to it: the triangle is to the right of or
 * above the edge.
 */
static int owns_edge(struct window_vertex a, struct window_vertex b)
{
	return b.y < a.y || (b.y == a.y && b.x > a.x);
}

/* 1 if the centre is on the inner side of a triangle's edge a -> b. sign: 1 for counter-clockwise triangles, else
 * -1. */
static int inside_edge(struct window_vertex a, struct window_vertex b, int sign, const struct pixel *p)
{
	const int64_t e = sign * edge(a, b, p);

	return e > 0 || (e == 0 && (sign > 0 ? owns_edge(a, b) : owns_edge(b, a)));
}

static int culled(uint32_t flags, int counter_clockwise)
{
	const int front = counter_clockwise == !(flags & INSTANCE_FRONT_CW);

	return (flags & (front ? INSTANCE_CULL_FRONT : INSTANCE_CULL_BACK)) != 0;
}

/* Sample position in the pixel, in pixels. */
static float spot(const struct pixel *p, int axis)
{
	return (float)(axis ? p->y : p->x) + 0.5f + (float)p->args->view->sample[axis] / 256;
}

static int in_viewport(const struct pixel *p)
{
	const float *v = p->args->view->viewport;
	const float x = spot(p, 0), y = spot(p, 1);

	return x >= v[0] && x < v[0] + v[2] && y >= v[1] && y < v[1] + v[3];
}

/* All vertices have a place in the window. corner, clip: as for clip_depth_plane; nearest fragments are compared by
 * exact depth. */
static int cover_placed(const struct pixel *p, uint32_t flags, const struct window_vertex v[3],
                        const struct clip_corner *const *corner, const struct vec4 *clip, struct fragment *f)
{
	const float z[3] = { v[0].z, v[1].z, v[2].z };
	const uint32_t height = p->args->height;
	struct clip_plane plane;
	const int64_t area = ((int64_t)v[1].x - v[0].x) * ((int64_t)v[2].y - v[0].y) -
	                     ((int64_t)v[2].x - v[0].x) * ((int64_t)v[1].y - v[0].y);
	const int sign = area > 0 ? 1 : -1;
	float inverse;

	if (area == 0 || culled(flags, sign > 0))
		return 0;
	for (int i = 0; i < 3; i++)
		if (!inside_edge(v[i], v[(i + 1) % 3], sign, p))
			return 0;
	inverse = 1.0f / (float)area;
	f->b1 = (float)edge(v[2], v[0], p) * inverse;
	f->b2 = (float)edge(v[0], v[1], p) * inverse;
	if (p->args->mode != CAMERA_COLUMN && clip_depth_plane(p->args->view, (float)height, corner, clip, z, &plane))
		f->depth = clamp01(clip_plane_in(&plane, p->args->view, (float)height, p->x, p->y));
	else
		f->depth = clamp01(v[0].z + (f->b1 * (v[1].z - v[0].z) + f->b2 * (v[2].z - v[0].z)));
	return 1;
}

/* A vertex lies outside the view volume: test the clipped triangle. c: clip coordinates. */
static int cover_clipped(const struct pixel *p, uint32_t flags, const float *const c[3], struct fragment *f)
{
	struct clip_polygon polygon;

	clip_triangle(p->args->view, (float)p->args->height, v4_load(c[0]), v4_load(c[1]), v4_load(c[2]), &polygon);
	for (uint32_t k = 2; k < polygon.n; k++) {
		const struct clip_corner *v0 = &polygon.corner[k - 1], *v1 = &polygon.corner[k], *v2 = &polygon.corner[0];

		if (!cover_placed(p, flags, (const struct window_vertex[]){ v0->window, v1->window, v2->window },
		                  (const struct clip_corner *const[]){ v0, v1, v2 }, NULL, f))
			continue;
		clip_weights(v0, v1, v2, f->b1, f->b2, &f->b1, &f->b2);
		f->primitive |= FRAGMENT_PERSPECTIVE;
		return 1;
	}
	return 0;
}

static void try_triangle(struct pixel *p, uint32_t instance_index, uint32_t primitive, const uint32_t vertex[3])
{
	const struct args *a = p->args;
	const struct instance *instance = &a->instances[instance_index];
	struct fragment f = { instance->primitive_first + primitive, instance_index, primitive, 0, 0, 0 };
	struct window_vertex v[3];
	struct vec4 clip[3];
	const float *c[3];
	int placed = 1;

	for (int i = 0; i < 3; i++) {
		v[i] = a->window[instance->vertex_first + vertex[i]];
		c[i] = a->clip[instance->vertex_first + vertex[i]];
		clip[i] = v4_load(c[i]);
		placed &= v[i].w_inv > 0;
	}
	if (placed ? cover_placed(p, instance->flags, v, NULL, clip, &f) : cover_clipped(p, instance->flags, c, &f))
		keep(p, &f);
}

/* A leaf of the binary or the compressed tree; triangle_first: of the instance. */
static void try_triangles(struct pixel *p, uint32_t instance_index, uint32_t triangle_first, uint32_t first,
                          uint32_t count)
{
	const struct triangle *triangles = p->args->triangles + triangle_first + first;

	for (uint32_t i = 0; i < count; i++)
		try_triangle(p, instance_index, triangles[i].primitive, triangles[i].vertex);
}

/* A leaf of the eight-wide tree. */
static void try_faces(struct pixel *p, uint32_t instance_index, uint32_t first, uint32_t count)
{
	const struct face8 *faces = p->args->faces + p->args->instances[instance_index].triangle8_first + first;

	for (uint32_t i = 0; i < count; i++)
		for (int lane = 0; lane < 8 && faces[i].primitive[lane] != SCENE_NONE; lane++)
			try_triangle(p, instance_index, faces[i].primitive[lane],
			             (const uint32_t[]){ faces[i].vertex[0][lane], faces[i].vertex[1][lane], faces[i].vertex[2][lane] });
}

/* --- traversal --------------------------------------------------------------------------------------------------- */

/* The segment of a ray inside a box widened by pad; 0: none. */
static int hits_box(const float o[3], const float inverse[3], const float lo[3], const float hi[3], float pad,
                    float t_max, float *t_enter)
{
	float enter = 0, leave = t_max;

	if (lo[0] > hi[0])
		return 0;
	for (int a = 0; a < 3; a++) {
		const float t0 = (lo[a] - pad - o[a]) * inverse[a], t1 = (hi[a] + pad - o[a]) * inverse[a];

		enter = fmaxf(enter, fminf(t0, t1));
		leave = fminf(leave, fmaxf(t0, t1));
	}
	*t_enter = enter;
	/* A little slack for rounding in t. */
	return enter <= leave * 1.00001f;
}

/* 1/d, finite: a ray parallel to a plane is tilted off it by a negligible amount. */
static void invert(const float d[3], float inverse[3])
{
	for (int a = 0; a < 3; a++)
		inverse[a] = 1.0f / (fabsf(d[a]) > 1e-20f ? d[a] : copysignf(1e-20f, d[a]));
}

static void walk_binary(struct pixel *p, uint32_t instance_index, const float o[3], const float inverse[3])
{
	const struct args *a = p->args;
	const struct instance *instance = &a->instances[instance_index];
	uint32_t stack[BVH_MAX_DEPTH], depth = 0, node_index = 0;

	for (;;) {
		const struct node2 *node = &a->nodes[instance->node2_first + node_index];
		float t[2];
		int hit[2], first;

		for (int side = 0; side < 2; side++)
			hit[side] = hits_box(o, inverse, node->lo[side], node->hi[side], instance->pad, p->t_max, &t[side]);
		first = hit[0] && hit[1] && t[1] < t[0];
		for (int i = 0; i < 2; i++) {
			const int side = first ^ i;

			if (hit[side])
				try_triangles(p, instance_index, instance->triangle_first, node->child[side], node->count[side]);
			hit[side] = hit[side] && !node->count[side];
		}
		if (hit[first] && hit[!first])
			stack[depth++] = node->child[!first];
		if (hit[0] || hit[1])
			node_index = node->child[hit[first] ? first : !first];
		else if (depth)
			node_index = stack[--depth];
		else
			return;
	}
}

/* 1 if the ray meets a box. inverse NULL: the sample position is a point, and boxes are tested in x and y. */
static int meets_box(const struct pixel *p, const float o[3], const float *inverse, const float lo[3],
                     const float hi[3], float pad)
{
	float t;

	return inverse ? hits_box(o, inverse, lo, hi, pad, p->t_max, &t)
	               : o[0] >= lo[0] - pad && o[0] <= hi[0] + pad && o[1] >= lo[1] - pad && o[1] <= hi[1] + pad;
}

static void walk_rows(struct pixel *p, uint32_t instance_index, const float o[3], const float *inverse)
{
	const struct instance *instance = &p->args->instances[instance_index];
	uint32_t stack[RAYS_WIDE_STACK], depth = 0;

	stack[depth++] = 0;
	while (depth) {
		const struct node8 *node = &p->args->rows[instance->node8_first + stack[--depth]];

		for (int lane = 0; lane < 8; lane++) {
			const float lo[3] = { node->lo[0][lane], node->lo[1][lane], node->lo[2][lane] };
			const float hi[3] = { node->hi[0][lane], node->hi[1][lane], node->hi[2][lane] };

			if (!(node->child[lane] | node->count[lane]) || !meets_box(p, o, inverse, lo, hi, instance->pad))
				continue;
			if (!node->count[lane])
				stack[depth++] = node->child[lane];
			try_faces(p, instance_index, node->child[lane], node->count[lane]);
		}
	}
}

static void walk_compressed(struct pixel *p, uint32_t instance_index, const float o[3], const float *inverse)
{
	const struct instance *instance = &p->args->instances[instance_index];
	const float pad = instance->pad;
	uint32_t stack[7 * NODE8C_MAX_DEPTH + 1], depth = 0;

	stack[depth++] = 0;
	while (depth) {
		const struct node8c *node = &p->args->compressed[instance->node8c_first + stack[--depth]];

		for (uint32_t slot = 0; slot < 8; slot++) {
			uint32_t first, count;
			float lo[3], hi[3];

			if (!node8c_box(node, slot, lo, hi) || !meets_box(p, o, inverse, lo, hi, pad))
				continue;
			count = node8c_child(node, slot, &first);
			if (!count)
				stack[depth++] = first;
			try_triangles(p, instance_index, instance->triangle8c_first, first, count);
		}
	}
}

static void walk_blas(struct pixel *p, uint32_t instance_index)
{
	const float *m = p->args->instances[instance_index].obj_from_eye;
	float o[3], d[3], inverse[3];

	for (int row = 0; row < 3; row++, m += 4) {
		o[row] = m[0] * p->o[0] + m[1] * p->o[1] + m[2] * p->o[2] + m[3];
		d[row] = m[0] * p->d[0] + m[1] * p->d[1] + m[2] * p->d[2];
	}
	invert(d, inverse);
	if (p->args->compressed)
		walk_compressed(p, instance_index, o, inverse);
	else if (p->args->rows)
		walk_rows(p, instance_index, o, inverse);
	else
		walk_binary(p, instance_index, o, inverse);
}

static void walk_top(struct pixel *p)
{
	const struct args *a = p->args;
	uint32_t stack[BVH_MAX_DEPTH], depth = 0;
	float inverse[3], t;

	if (a->view->tlas_count == 0)
		return;
	invert(p->d, inverse);
	stack[depth++] = 0;
	while (depth) {
		const struct node2 *node = &a->top[a->view->tlas_first + stack[--depth]];

		for (int side = 0; side < 2; side++) {
			if (!hits_box(p->o, inverse, node->lo[side], node->hi[side], 0, p->t_max, &t))
				continue;
			if (!node->count[side])
				stack[depth++] = node->child[side];
			for (uint32_t k = 0; k < node->count[side]; k++)
				walk_blas(p, a->instance_list[node->child[side] + k]);
		}
	}
}

/* Geometry in window space is tested at the sample position, as a point. */
static void walk_screen(struct pixel *p, uint32_t instance_index)
{
	const struct args *a = p->args;
	const struct instance *instance = &a->instances[instance_index];
	const float at[3] = { spot(p, 0), spot(p, 1), 0 };
	uint32_t stack[BVH_MAX_DEPTH], depth = 0;

	if (a->compressed || a->rows) {
		(a->compressed ? walk_compressed : walk_rows)(p, instance_index, at, NULL);
		return;
	}
	stack[depth++] = 0;
	while (depth) {
		const struct node2 *node = &a->nodes[instance->node2_first + stack[--depth]];

		for (int side = 0; side < 2; side++) {
			if (!meets_box(p, at, NULL, node->lo[side], node->hi[side], instance->pad))
				continue;
			if (!node->count[side])
				stack[depth++] = node->child[side];
			try_triangles(p, instance_index, instance->triangle_first, node->child[side], node->count[side]);
		}
	}
}

/* The pixel's ray; 0 if the view has none (its projection has no inverse). */
static int make_ray(struct pixel *p)
{
	const struct view *view = p->args->view;
	const float x = 2.0f * (spot(p, 0) - view->viewport[0]) / view->viewport[2] - 1.0f;
	const float y = 2.0f * (spot(p, 1) - view->viewport[1]) / view->viewport[3] - 1.0f;
	const float *m = view->inverse;
	float near[4], far[4], finite;

	for (int row = 0; row < 4; row++) {
		near[row] = m[row] * x + m[4 + row] * y + (m[12 + row] - m[8 + row]);
		far[row] = m[row] * x + m[4 + row] * y + (m[12 + row] + m[8 + row]);
	}
	for (int a = 0; a < 3; a++) {
		p->o[a] = near[a] / near[3];
		p->d[a] = far[a] * near[3] - near[a] * far[3];
	}
	p->d_scale = fmaxf(fabsf(p->d[0]), fmaxf(fabsf(p->d[1]), fabsf(p->d[2])));
	for (int a = 0; a < 3; a++)
		p->d[a] /= p->d_scale;
	finite = 0 * (p->o[0] + p->o[1] + p->o[2]) + 0 * (p->d[0] + p->d[1] + p->d[2]);
	p->near_w = near[3];
	p->far_w = far[3];
	p->t_max = 1e30f;
	return finite == 0;
}

static void do_pixel(const struct args *args, int32_t x, int32_t y)
{
	const size_t index = place_of(args, x, y);
	struct pixel p = { .args = args, .x = x, .y = y };

	p.fragments = args->fragments + (args->mode == CAMERA_COLUMN ? index * CAMERA_COLUMN_MAX : index);
	if (args->mode != CAMERA_COLUMN)
		p.fragments[0] = (struct fragment){ SCENE_NONE, SCENE_NONE, SCENE_NONE, 0, 0, 1 };
	if (in_viewport(&p) && make_ray(&p))
		walk_top(&p);
	for (uint32_t i = 0; i < args->view->screen_count; i++)
		walk_screen(&p, args->view->screen_first + i);
	args->counts[index] = p.count;
}

void camera_packet_c(const struct camera_packet_arguments *from, size_t first, size_t last)
{
	const struct args a = { COMMON_ARGS(from), .rows = from->nodes, .faces = from->triangles };
	const struct camera_rectangle r = a.rectangle;

	for (size_t item = first; item < last && item < camera_packet_items(r); item++) {
		const int32_t x0 = camera_packet_x(r, (uint32_t)item), y0 = camera_packet_y(r, (uint32_t)item);

		for (int32_t y = y0 > r.y0 ? y0 : r.y0; y < y0 + CAMERA_TILE && y < r.y1; y++)
			for (int32_t x = x0 > r.x0 ? x0 : r.x0; x < x0 + CAMERA_TILE && x < r.x1; x++)
				do_pixel(&a, x, y);
	}
}

static void do_pixels(const struct args *a, size_t first, size_t last)
{
	const struct camera_rectangle r = a->rectangle;

	for (size_t item = first; item < last && item < camera_wide_items(r); item++) {
		const int32_t x = camera_wide_x(r, (uint32_t)item), y = camera_wide_y(r, (uint32_t)item);

		if (x < r.x1 && y < r.y1)
			do_pixel(a, x, y);
	}
}

void camera_wide_c(const struct camera_wide_arguments *from, size_t first, size_t last)
{
	const struct args a = { COMMON_ARGS(from), .nodes = from->nodes, .triangles = from->triangles };

	do_pixels(&a, first, last);
}

void camera_compressed_c(const struct camera_compressed_arguments *from, size_t first, size_t last)
{
	const struct args a = { COMMON_ARGS(from), .compressed = from->nodes, .triangles = from->triangles };

	do_pixels(&a, first, last);
}
