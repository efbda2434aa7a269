/*
 * camera_wide, camera_compressed: one pixel per work item, for devices that run many work items in lockstep. See
 * kernels/camera/camera.h.
 */
#include "kernels/camera/camera.h"
#include "kernels/camera/coverage.h"
#include "kernels/kernels.h"
#include "kernels/rays/compressed_node.h"

/* State of a pixel during traversal. */
struct pixel {
	__global const struct view *view;
	__global const struct instance *instances;
	__global const struct node2 *nodes;
	__global const struct node8c *compressed; /* instead of nodes */
	__global const struct triangle *triangles;
	__global const struct window_vertex *window;
	__global const float *clip;
	__global struct fragment *out; /* the pixel's column, or its nearest fragment */
	uint mode, height, after;
	int x, y;
	struct vec3 o, d;
	float d_scale, near_w, far_w, t_max;
	uint count, steps;
	struct fragment nearest;
};

static inline void shorten(struct pixel *p, float depth)
{
	const float near = p->view->depth_range[0], range = p->view->depth_range[1] - near;
	const float u = (depth - near) / range + 4e-7f;
	const float w = (1.0f - u) * p->near_w + u * p->far_w - 1e-6f * p->near_w;

	/* With a reversed depth range, the nearest depth is not the first along the ray. */
	if (range > 0 && w * p->near_w > 0)
		p->t_max = fmin(p->t_max, u * p->d_scale / (p->near_w * w));
}

static inline void keep_nearest(struct pixel *p, const struct fragment *f)
{
	const uint steps = convert_uint(rint(f->depth * 16777215.0f));

	if (p->count && (steps > p->steps || (steps == p->steps && (p->mode == CAMERA_NEAREST_LESS
	                                                                   ? f->order > p->nearest.order
	                                                                   : f->order < p->nearest.order))))
		return;
	p->nearest = *f;
	p->steps = steps;
	p->count = 1;
	shorten(p, f->depth);
}

static inline void keep_in_column(struct pixel *p, const struct fragment *f)
{
	uint place = p->count;

	if (f->order < p->after)
		return;
	while (place > 0 && p->out[place - 1].order > f->order)
		place--;
	/* A triangle may be in several leaves. */
	if (place == CAMERA_COLUMN_MAX || (place > 0 && p->out[place - 1].order == f->order))
		return;
	if (p->count < CAMERA_COLUMN_MAX)
		p->count++;
	for (uint i = p->count - 1; i > place; i--)
		p->out[i] = p->out[i - 1];
	p->out[place] = *f;
}

static inline void try_triangle(struct pixel *p, uint index, __global const struct instance *instance,
                         __global const struct triangle *triangle)
{
	const uint first = instance->vertex_first;
	const uint i0 = first + triangle->vertex[0], i1 = first + triangle->vertex[1], i2 = first + triangle->vertex[2];
	const struct window_vertex v0 = p->window[i0], v1 = p->window[i1], v2 = p->window[i2];
	const int exact = p->mode != CAMERA_COLUMN;
	struct fragment f;
	int covered;

	f.order = instance->primitive_first + triangle->primitive;
	f.instance = index;
	f.primitive = triangle->primitive;
	if (v0.w_inv > 0 && v1.w_inv > 0 && v2.w_inv > 0) {
		covered = coverage_placed(v0, v1, v2, instance->flags, clip_spot(p->view, p->x, p->y), &f.b1, &f.b2, &f.depth);
		if (covered && exact) {
			const struct vec4 clip[3] = { v4_load(p->clip + 4 * i0), v4_load(p->clip + 4 * i1), v4_load(p->clip + 4 * i2) };
			const float z[3] = { v0.z, v1.z, v2.z };

			f.depth = coverage_depth(p->view, p->height, 0, clip, z, p->x, p->y, f.depth);
		}
	} else {
		covered = coverage_clipped(p->view, p->clip, p->height, i0, i1, i2, instance->flags, exact, p->x, p->y, &f.b1, &f.b2,
		                           &f.depth);
		f.primitive |= FRAGMENT_PERSPECTIVE;
	}
	if (!covered)
		return;
	if (p->mode == CAMERA_COLUMN)
		keep_in_column(p, &f);
	else
		keep_nearest(p, &f);
}

static inline struct vec3 invert_all(struct vec3 d)
{
	return v3(invert(d.x), invert(d.y), invert(d.z));
}

/* Test the ray against a box widened by pad, and find where it enters. */
static inline int pixel_meets_box(struct vec3 lo, struct vec3 hi, struct vec3 o, struct vec3 inverse, float pad,
                                  float t_max, float *enter)
{
	const float x0 = (lo.x - pad - o.x) * inverse.x, x1 = (hi.x + pad - o.x) * inverse.x;
	const float y0 = (lo.y - pad - o.y) * inverse.y, y1 = (hi.y + pad - o.y) * inverse.y;
	const float z0 = (lo.z - pad - o.z) * inverse.z, z1 = (hi.z + pad - o.z) * inverse.z;

	*enter = fmax(fmax(fmin(x0, x1), fmin(y0, y1)), fmax(fmin(z0, z1), 0.0f));
	/* A little slack for rounding in t; an empty side has lo > hi. */
	return lo.x <= hi.x && *enter <= fmin(fmin(fmax(x0, x1), fmax(y0, y1)), fmin(fmax(z0, z1), t_max)) * 1.00001f;
}

/* The same for one side of a binary node. */
static inline int meets_side(__global const struct node2 *node, uint side, struct vec3 o, struct vec3 inverse,
                             float pad, float t_max, float *enter)
{
	return pixel_meets_box(v3_load(node->lo[side]), v3_load(node->hi[side]), o, inverse, pad, t_max, enter);
}

static inline void pixel_walk_binary(struct pixel *p, uint index, struct vec3 o, struct vec3 inverse)
{
	__global const struct instance *instance = &p->instances[index];
	__global const struct node2 *nodes = p->nodes + instance->node2_first;
	uint stack[BVH_MAX_DEPTH + 1], depth = 0, child = 0;

	for (;;) {
		__global const struct node2 *node = &nodes[child];
		float enter0, enter1;
		int hit0 = meets_side(node, 0, o, inverse, instance->pad, p->t_max, &enter0);
		int hit1 = meets_side(node, 1, o, inverse, instance->pad, p->t_max, &enter1);
		const uint first = hit0 && hit1 && enter1 < enter0;

		for (uint i = 0; i < 2; i++) {
			const uint side = first ^ i;

			if (!(side ? hit1 : hit0) || node->count[side] == 0)
				continue;
			for (uint k = 0; k < node->count[side]; k++)
				try_triangle(p, index, instance, &p->triangles[instance->triangle_first + node->child[side] + k]);
		}
		hit0 = hit0 && node->count[0] == 0;
		hit1 = hit1 && node->count[1] == 0;
		if (hit0 && hit1) {
			stack[depth++] = node->child[!first];
			child = node->child[first];
		} else if (hit0 || hit1) {
			child = node->child[hit1];
		} else if (depth) {
			child = stack[--depth];
		} else {
			return;
		}
	}
}

/* Test whether a box, widened by pad, contains a window position in x and y. */
static inline int is_below(float2 lo, float2 hi, float2 at, float pad)
{
	return all(at >= lo - pad) && all(at <= hi + pad);
}

/* The pixel's ray prepared for 80-byte nodes: boxes are widened by pad, and t starts at the ray's origin. */
static inline struct walk compressed_ray(struct vec3 o, struct vec3 d, float pad)
{
	struct walk w;

	w.ox = o.x, w.oy = o.y, w.oz = o.z;
	w.dx = d.x, w.dy = d.y, w.dz = d.z;
	w.t_min = 0;
	prepare(&w);
	w.near_x -= pad * fabs(w.ix), w.near_y -= pad * fabs(w.iy), w.near_z -= pad * fabs(w.iz);
	w.far_x += pad * fabs(w.far_ix), w.far_y += pad * fabs(w.far_iy), w.far_z += pad * fabs(w.far_iz);
	return w;
}

/* Visits nodes in the order of the ray's octant, roughly front to back, as in kernels/rays/rays_single.cl. is_screen:
 * the ray's end is w's */
static inline void pixel_walk_compressed(struct pixel *p, uint index, struct walk *w, int is_screen)
{
	__global const struct instance *instance = &p->instances[index];
	__global const struct node8c *nodes = p->compressed + instance->node8c_first;
	__global const struct triangle *triangles = p->triangles + instance->triangle8c_first;
	const uint octant = (w->ix < 0 ? 0u : 1u) | (w->iy < 0 ? 0u : 2u) | (w->iz < 0 ? 0u : 4u);
	uint2 stack[NODE8C_MAX_DEPTH]; /* as in walk_compressed */
	uint depth = 0, child = 0;

	for (;;) {
		uint bits, near, slot;
		uint2 first, group;

		w->hit.t = is_screen ? w->hit.t : p->t_max;
		group.y = meet_compressed(w, octant, &nodes[child], &bits, &first);
		group.x = first.x;
		for (; bits; bits &= bits - 1)
			try_triangle(p, index, instance, &triangles[first.y + popcount((bits & -bits) - 1)]);
		if (!(group.y & 255u)) {
			if (depth == 0)
				return;
			group = stack[--depth];
		}
		near = 31 - clz(group.y & 255u);
		slot = near ^ octant;
		group.y &= ~(1u << near);
		if (group.y & 255u)
			stack[depth++] = group;
		child = group.x + popcount(group.y >> 8 & ((1u << slot) - 1u));
	}
}

INLINED void walk_blas(struct pixel *p, uint index, int is_compressed)
{
	__global const float *m = p->instances[index].obj_from_eye;
	const struct vec3 r0 = v3_load(m), r1 = v3_load(m + 4), r2 = v3_load(m + 8);
	const struct vec3 o = v3(v3_dot(r0, p->o) + m[3], v3_dot(r1, p->o) + m[7], v3_dot(r2, p->o) + m[11]);
	const struct vec3 d = v3(v3_dot(r0, p->d), v3_dot(r1, p->d), v3_dot(r2, p->d));

	if (is_compressed) {
		struct walk w = compressed_ray(o, d, p->instances[index].pad);

		pixel_walk_compressed(p, index, &w, 0);
	} else {
		pixel_walk_binary(p, index, o, invert_all(d));
	}
}

INLINED void walk_top(struct pixel *p, int is_compressed, __global const struct node2 *top,
                      __global const uint *instance_list)
{
	const struct vec3 inverse = invert_all(p->d);
	uint stack[BVH_MAX_DEPTH + 1], depth = 0;
	float enter;

	stack[depth++] = 0;
	while (depth) {
		__global const struct node2 *node = &top[stack[--depth]];

		for (uint side = 0; side < 2; side++) {
			if (!meets_side(node, side, p->o, inverse, 0, p->t_max, &enter))
				continue;
			if (node->count[side] == 0)
				stack[depth++] = node->child[side];
			for (uint i = 0; i < node->count[side]; i++)
				walk_blas(p, instance_list[node->child[side] + i], is_compressed);
		}
	}
}

/* Sample position in the pixel, in pixels. */
static inline float2 pixel_spot(const struct pixel *p)
{
	return (float2)((float)p->x, (float)p->y) + 0.5f +
	       (float2)((float)p->view->sample[0], (float)p->view->sample[1]) * 0.00390625f;
}

static inline void walk_screen_binary(struct pixel *p, uint index, float2 at)
{
	__global const struct instance *instance = &p->instances[index];
	__global const struct node2 *nodes = p->nodes + instance->node2_first;
	uint stack[BVH_MAX_DEPTH + 1], depth = 0;

	stack[depth++] = 0;
	while (depth) {
		__global const struct node2 *node = &nodes[stack[--depth]];

		for (uint side = 0; side < 2; side++) {
			if (!is_below(vload2(0, node->lo[side]), vload2(0, node->hi[side]), at, instance->pad))
				continue;
			if (node->count[side] == 0)
				stack[depth++] = node->child[side];
			for (uint i = 0; i < node->count[side]; i++)
				try_triangle(p, index, instance, &p->triangles[instance->triangle_first + node->child[side] + i]);
		}
	}
}

/* Test a window position, at any depth, as a point. */
static inline void walk_screen_compressed(struct pixel *p, uint index, float2 at)
{
	struct walk w = compressed_ray(v3(at.x, at.y, 0), v3(0, 0, 1), p->instances[index].pad);

	w.t_min = -1e30f;
	w.hit.t = 1e30f;
	pixel_walk_compressed(p, index, &w, 1);
}

/* Test geometry in window space. */
INLINED void walk_screen(struct pixel *p, uint index, int is_compressed)
{
	if (is_compressed)
		walk_screen_compressed(p, index, pixel_spot(p));
	else
		walk_screen_binary(p, index, pixel_spot(p));
}

/* 0 if the pixel has no ray: it is outside the viewport, or the projection has no inverse. */
static inline int make_ray(struct pixel *p)
{
	__global const float *m = p->view->inverse, *viewport = p->view->viewport;
	const float px = pixel_spot(p).x, py = pixel_spot(p).y;
	const float x = 2.0f * (px - viewport[0]) / viewport[2] - 1.0f;
	const float y = 2.0f * (py - viewport[1]) / viewport[3] - 1.0f;
	const float4 near = vload4(0, m) * x + vload4(1, m) * y + (vload4(3, m) - vload4(2, m));
	const float4 far = vload4(0, m) * x + vload4(1, m) * y + (vload4(3, m) + vload4(2, m));

	p->o = v3(near.x / near.w, near.y / near.w, near.z / near.w);
	p->d = v3(far.x * near.w - near.x * far.w, far.y * near.w - near.y * far.w, far.z * near.w - near.z * far.w);
	p->d_scale = fmax(fabs(p->d.x), fmax(fabs(p->d.y), fabs(p->d.z)));
	p->d = v3(p->d.x / p->d_scale, p->d.y / p->d_scale, p->d.z / p->d_scale);
	p->near_w = near.w;
	p->far_w = far.w;
	p->t_max = 1e30f;
	return px >= viewport[0] && px < viewport[0] + viewport[2] && py >= viewport[1] && py < viewport[1] + viewport[3] &&
	       isfinite(p->o.x + p->o.y + p->o.z) && isfinite(p->d.x + p->d.y + p->d.z);
}

/*
 * p: with its trees set; the rest is set here. Each kernel compiles this for one kind of tree, and so only has stacks
 * of that kind.
 */
INLINED void do_pixel(int is_compressed, struct pixel *p, const struct camera_pass *pass,
                      __global const struct node2 *top, __global const uint *instance_list)
{
	__global const struct view *view = &pass->views[pass->view_index];
	const struct camera_rectangle r = pass->rectangle;
	const uint item = (uint)get_global_id(0);
	uint pixel;

	p->x = camera_wide_x(r, item);
	p->y = camera_wide_y(r, item);
	if (p->x >= r.x1 || p->y >= r.y1)
		return;
	p->view = view;
	p->window = pass->window;
	p->clip = pass->clip;
	p->mode = pass->mode;
	p->height = pass->height;
	pixel = (uint)p->y * pass->width + (uint)p->x - pass->first_pixel;
	p->after = p->mode == CAMERA_COLUMN ? pass->after[pixel] : 0;
	p->out = pass->fragments + (p->mode == CAMERA_COLUMN ? (size_t)pixel * CAMERA_COLUMN_MAX : pixel);
	p->count = p->steps = 0;
	p->nearest.order = p->nearest.instance = p->nearest.primitive = SCENE_NONE;
	p->nearest.b1 = p->nearest.b2 = 0;
	p->nearest.depth = 1;
	if (view->tlas_count && make_ray(p))
		walk_top(p, is_compressed, top + view->tlas_first, instance_list);
	for (uint i = 0; i < view->screen_count; i++)
		walk_screen(p, view->screen_first + i, is_compressed);
	if (p->mode != CAMERA_COLUMN)
		*p->out = p->nearest;
	pass->counts[pixel] = p->count;
}

__kernel void camera_wide(KERNEL_ARGUMENTS(camera_wide))
{
	const struct camera_pass pass = KERNEL_STRUCT(camera_pass);
	struct pixel p;

	p.instances = instances;
	p.nodes = nodes;
	p.compressed = 0;
	p.triangles = triangles;
	do_pixel(0, &p, &pass, top, instance_list);
}

__kernel void camera_compressed(KERNEL_ARGUMENTS(camera_compressed))
{
	const struct camera_pass pass = KERNEL_STRUCT(camera_pass);
	struct pixel p;

	p.instances = instances;
	p.nodes = 0;
	p.compressed = nodes;
	p.triangles = triangles;
	do_pixel(1, &p, &pass, top, instance_list);
}
