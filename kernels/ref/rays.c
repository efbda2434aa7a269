/* C twins of the occlude and intersect kernels: one ray at a time, as specified in kernels/rays/rays.h. */
#include "kernels/rays/rays.h"

#include <math.h>

#include "kernels/kernels.h"
#include "kernels/rays/compressed.h"
#include "kernels/rays/opacity.h"

/* Type of the trees' nodes. */
enum tree { TREE_ROWS, TREE_BINARY, TREE_COMPRESSED };

/* Arguments that all the kernels share. */
struct args {
	uint32_t n_rays;
	const struct ray *rays;
	uint32_t top_first;
	const void *top;
	const uint32_t *instance_list;
	const struct instance *instances;
	const void *nodes, *triangles;
	enum tree tree;
	const uint32_t *opacity; /* NULL: nothing is known of surfaces */
	const struct hit *last;  /* hits that the rays continue behind; NULL: none */
};
#define ARGS_OF(a, kind) \
	{ (a)->n_rays, (a)->rays, (a)->top_first, (a)->top, (a)->instance_list, (a)->instances, (a)->nodes, (a)->triangles, \
	kind, NULL, NULL }

/* State of a ray during traversal. */
struct walk {
	const struct args *args;
	float o[3], d[3], inverse[3]; /* in the space of the tree that it walks */
	float t_min;
	struct hit hit; /* hit.t: end of the ray so far */
	int any;        /* 1: any hit will do */
	uint32_t asks;  /* 1: it hit a surface that has to be sampled */
	uint32_t to_lights, passes, opacity; /* as in kernels/rays/rays.h and opacity.h; for the instance that it walks */
	const struct hit *last; /* the hit that the ray continues behind, or NULL */
	float after, shift;     /* t of that hit, in eye space; added to t, gives t in eye space */
	uint32_t tie;           /* the least primitive of the instance that counts at that t */
};

static int done(const struct walk *w)
{
	return w->any && w->hit.instance != SCENE_NONE;
}

static float dot(const float a[3], const float b[3])
{
	return fmaf(a[2], b[2], fmaf(a[1], b[1], a[0] * b[0]));
}

static void cross(const float a[3], const float b[3], float out[3])
{
	out[0] = fmaf(a[1], b[2], -(a[2] * b[1]));
	out[1] = fmaf(a[2], b[0], -(a[0] * b[2]));
	out[2] = fmaf(a[0], b[1], -(a[1] * b[0]));
}

static float largest(const float v[3])
{
	return fmaxf(fmaxf(fabsf(v[0]), fabsf(v[1])), fabsf(v[2]));
}

/* 1 if a ray goes on behind a hit on a side of a primitive. Any-hit queries set w->asks after one that has to be
 * sampled. */
static int ignores(struct walk *w, uint32_t primitive, uint32_t side, float u, float v)
{
	const uint32_t *words = w->args->opacity;
	uint32_t word, does;

	if (w->passes & side)
		return 1;
	if (!w->any || !words)
		return 0;
	word = opacity_word(words, w->opacity, primitive);
	if (opacity_sides(word, w->to_lights) & side)
		return 1;
	does = opacity_at(words, w->opacity, word, u, v);
	w->asks |= does == OPACITY_ASK;
	return does != OPACITY_STOPS;
}

static void try_triangle(struct walk *w, const float v0[3], const float e1[3], const float e2[3], uint32_t instance,
                         uint32_t primitive)
{
	float p[3], q[3], s[3], det, inverse, u, v, t;

	cross(w->d, e2, p);
	det = dot(e1, p);
	inverse = 1.0f / det;
	for (int a = 0; a < 3; a++)
		s[a] = w->o[a] - v0[a];
	u = dot(s, p) * inverse;
	cross(s, e1, q);
	v = dot(w->d, q) * inverse;
	t = dot(e2, q) * inverse;
	/* A determinant of 0 makes u and v NaN or infinite, which fails here. */
	if (u >= -RAYS_EDGE_SLACK && v >= -RAYS_EDGE_SLACK && u + v <= 1 + RAYS_EDGE_SLACK && t >= w->t_min &&
	    (t < w->hit.t || (t == w->hit.t && primitive < w->hit.primitive)) &&
	    (t + w->shift > w->after || (t + w->shift == w->after && primitive >= w->tie)) &&
	    RAYS_FLAT * largest(e1) * largest(e2) * (largest(w->d) * fabsf(inverse)) < 1 &&
	    !ignores(w, primitive, rays_side(inverse), u, v))
		w->hit = (struct hit){ t, u, v, instance, primitive };
}

static int hits_box(const struct walk *w, const float lo[3], const float hi[3])
{
	float enter = w->t_min, leave = w->hit.t;

	if (lo[0] > hi[0])
		return 0;
	for (int a = 0; a < 3; a++) {
		const float t0 = (lo[a] - w->o[a]) * w->inverse[a], t1 = (hi[a] - w->o[a]) * w->inverse[a];

		enter = fmaxf(enter, fminf(t0, t1));
		leave = fminf(leave, fmaxf(t0, t1));
	}
	/* A little slack for rounding in t. */
	return enter <= leave + 1e-5f * fabsf(leave);
}

static int hits_lane(const struct walk *w, const struct node8 *node, int lane)
{
	const float lo[3] = { node->lo[0][lane], node->lo[1][lane], node->lo[2][lane] };
	const float hi[3] = { node->hi[0][lane], node->hi[1][lane], node->hi[2][lane] };

	return hits_box(w, lo, hi);
}

/* d, and 1/d, finite: a ray parallel to a plane is tilted off it by a negligible amount. @return 0: it hits nothing
 * from its o */
static int set_direction(struct walk *w, const float d[3])
{
	int in_range = 1;

	for (int a = 0; a < 3; a++) {
		w->d[a] = d[a];
		w->inverse[a] = 1.0f / (fabsf(d[a]) > 1e-20f ? d[a] : copysignf(1e-20f, d[a]));
		in_range &= fabsf(w->o[a] * w->inverse[a]) < RAYS_RANGE;
	}
	return in_range;
}

static void try_block(struct walk *w, const struct triangle8 *block, uint32_t instance_index)
{
	for (int lane = 0; lane < 8 && block->primitive[lane] != SCENE_NONE && !done(w); lane++) {
		const float v0[3] = { block->v0[0][lane], block->v0[1][lane], block->v0[2][lane] };
		const float e1[3] = { block->e1[0][lane], block->e1[1][lane], block->e1[2][lane] };
		const float e2[3] = { block->e2[0][lane], block->e2[1][lane], block->e2[2][lane] };

		try_triangle(w, v0, e1, e2, instance_index, block->primitive[lane]);
	}
}

static void walk_rows(struct walk *w, uint32_t instance_index)
{
	const struct args *a = w->args;
	const struct instance *instance = &a->instances[instance_index];
	const struct node8 *nodes = (const struct node8 *)a->nodes + instance->node8_first;
	const struct triangle8 *triangles = (const struct triangle8 *)a->triangles + instance->triangle8_first;
	uint32_t stack[RAYS_WIDE_STACK], depth = 0;

	stack[depth++] = 0;
	while (depth && !done(w)) {
		const struct node8 *node = &nodes[stack[--depth]];

		for (int lane = 0; lane < 8; lane++) {
			if (!hits_lane(w, node, lane))
				continue;
			if (!node->count[lane])
				stack[depth++] = node->child[lane];
			for (uint32_t k = 0; k < node->count[lane] && !done(w); k++)
				try_block(w, &triangles[node->child[lane] + k], instance_index);
		}
	}
}

static void try_triangles(struct walk *w, const struct triangle *triangles, uint32_t n, uint32_t instance_index)
{
	for (uint32_t i = 0; i < n && !done(w); i++)
		try_triangle(w, triangles[i].v0, triangles[i].e1, triangles[i].e2, instance_index, triangles[i].primitive);
}

static void walk_binary(struct walk *w, uint32_t instance_index)
{
	const struct args *a = w->args;
	const struct instance *instance = &a->instances[instance_index];
	const struct node2 *nodes = (const struct node2 *)a->nodes + instance->node2_first;
	const struct triangle *triangles = (const struct triangle *)a->triangles + instance->triangle_first;
	uint32_t stack[BVH_MAX_DEPTH + 1], depth = 0;

	stack[depth++] = 0;
	while (depth && !done(w)) {
		const struct node2 *node = &nodes[stack[--depth]];

		for (int side = 0; side < 2; side++) {
			if (!hits_box(w, node->lo[side], node->hi[side]))
				continue;
			if (!node->count[side])
				stack[depth++] = node->child[side];
			try_triangles(w, triangles + node->child[side], node->count[side], instance_index);
		}
	}
}

static void walk_compressed(struct walk *w, uint32_t instance_index)
{
	const struct args *a = w->args;
	const struct instance *instance = &a->instances[instance_index];
	const struct node8c *nodes = (const struct node8c *)a->nodes + instance->node8c_first;
	const struct triangle *triangles = (const struct triangle *)a->triangles + instance->triangle8c_first;
	uint32_t stack[7 * NODE8C_MAX_DEPTH + 1], depth = 0;

	stack[depth++] = 0;
	while (depth && !done(w)) {
		const struct node8c *node = &nodes[stack[--depth]];

		for (uint32_t slot = 0; slot < 8; slot++) {
			float lo[3], hi[3];
			uint32_t first, count;

			if (!node8c_box(node, slot, lo, hi) || !hits_box(w, lo, hi))
				continue;
			count = node8c_child(node, slot, &first);
			if (!count)
				stack[depth++] = first;
			else
				try_triangles(w, triangles + first, count, instance_index);
		}
	}
}

static void walk_blas(struct walk *w, uint32_t instance_index)
{
	if (w->args->tree == TREE_ROWS)
		walk_rows(w, instance_index);
	else if (w->args->tree == TREE_BINARY)
		walk_binary(w, instance_index);
	else
		walk_compressed(w, instance_index);
}

/* Distance along the ray where its walk through an instance starts. */
static float far_shift(const struct instance *instance, const float o[3], const float d[3])
{
	const float c[3] = { instance->centre[0] - o[0], instance->centre[1] - o[1], instance->centre[2] - o[2] };
	const float length = fmaxf(fmaxf(fabsf(d[0]), fabsf(d[1])), fabsf(d[2]));
	const float shift = dot(c, d) / dot(d, d) - instance->radius / length;

	return shift * length > RAYS_FAR * instance->radius && isfinite(shift) ? shift : 0;
}

/* The least primitive of an instance that comes after a hit at the same t. */
static uint32_t tie_of(const struct hit *last, uint32_t instance)
{
	return instance > last->instance ? 0 : instance == last->instance ? last->primitive + 1 : SCENE_NONE;
}

/* Enter an instance's object space, walk its tree, and return. */
static void walk_instance(struct walk *w, uint32_t instance_index)
{
	const struct walk eye = *w;
	const struct instance *instance = &w->args->instances[instance_index];
	const float *m = instance->obj_from_eye;
	float d[3], shift;
	int in_range;

	for (int row = 0; row < 3; row++, m += 4) {
		w->o[row] = fmaf(m[2], eye.o[2], fmaf(m[1], eye.o[1], fmaf(m[0], eye.o[0], m[3])));
		d[row] = fmaf(m[2], eye.d[2], fmaf(m[1], eye.d[1], m[0] * eye.d[0]));
	}
	shift = far_shift(instance, w->o, d);
	for (int a = 0; a < 3; a++)
		w->o[a] = fmaf(shift, d[a], w->o[a]);
	in_range = set_direction(w, d);
	w->t_min = eye.t_min - shift;
	w->hit = (struct hit){ eye.hit.t - shift, 0, 0, SCENE_NONE, SCENE_NONE };
	if (shift > 0 && eye.hit.instance != SCENE_NONE)
		w->hit.t += 3e-7f * eye.hit.t; /* t + shift decides */
	w->passes = rays_passes(instance->flags, w->to_lights);
	w->opacity = instance->opacity;
	w->shift = shift;
	w->tie = w->last ? tie_of(w->last, instance_index) : 0;
	if (in_range)
		walk_blas(w, instance_index);
	w->hit.t += shift;
	if (w->hit.instance == SCENE_NONE || (eye.hit.instance != SCENE_NONE && !(w->hit.t < eye.hit.t) &&
	                                      !(w->hit.t == eye.hit.t && instance_index < eye.hit.instance)))
		w->hit = eye.hit;
	w->t_min = eye.t_min;
	for (int a = 0; a < 3; a++) {
		w->o[a] = eye.o[a];
		w->d[a] = eye.d[a];
		w->inverse[a] = eye.inverse[a];
	}
}

static void walk_instances(struct walk *w, uint32_t first, uint32_t n)
{
	for (uint32_t i = 0; i < n && !done(w); i++)
		walk_instance(w, w->args->instance_list[first + i]);
}

static void walk_top_rows(struct walk *w)
{
	const struct node8 *top = (const struct node8 *)w->args->top + w->args->top_first;
	uint32_t stack[RAYS_WIDE_STACK], depth = 0;

	stack[depth++] = 0;
	while (depth && !done(w)) {
		const struct node8 *node = &top[stack[--depth]];

		for (int lane = 0; lane < 8; lane++) {
			if (!hits_lane(w, node, lane))
				continue;
			if (!node->count[lane])
				stack[depth++] = node->child[lane];
			walk_instances(w, node->child[lane], node->count[lane]);
		}
	}
}

static void walk_top_binary(struct walk *w)
{
	const struct node2 *top = (const struct node2 *)w->args->top + w->args->top_first;
	uint32_t stack[BVH_MAX_DEPTH + 1], depth = 0;

	stack[depth++] = 0;
	while (depth && !done(w)) {
		const struct node2 *node = &top[stack[--depth]];

		for (int side = 0; side < 2; side++) {
			if (!hits_box(w, node->lo[side], node->hi[side]))
				continue;
			if (!node->count[side])
				stack[depth++] = node->child[side];
			walk_instances(w, node->child[side], node->count[side]);
		}
	}
}

static struct walk walk_ray(const struct args *args, uint32_t index, int any, uint32_t to_lights)
{
	const struct ray *ray = &args->rays[index];
	const struct hit *last = args->last ? &args->last[index] : NULL;
	struct walk w = { .args = args, .t_min = ray->t_min, .any = any, .to_lights = to_lights, .last = last };

	w.after = last ? ray->t_min : -INFINITY;
	if (last)
		w.t_min = fmaf(fabsf(ray->t_min), -RAYS_END_SLACK, ray->t_min);
	w.hit = (struct hit){ ray->t_max, 0, 0, SCENE_NONE, SCENE_NONE };
	if (!(ray->t_min <= ray->t_max))
		return w;
	for (int a = 0; a < 3; a++) {
		if (!isfinite(ray->o[a]) || !isfinite(ray->d[a]))
			return w;
		w.o[a] = ray->o[a];
	}
	if (!set_direction(&w, ray->d))
		return w;
	if (args->tree == TREE_ROWS)
		walk_top_rows(&w);
	else
		walk_top_binary(&w);
	return w;
}

/* The result of an any-hit query. */
static uint32_t occluded_of(struct walk w)
{
	return w.hit.instance != SCENE_NONE ? 1 : w.asks * 2;
}

/* The twins of one argument list: any hit, and nearest hit. words: opacity, or NULL */
#define TWINS(list, tree, words) \
	void occlude_##list##_c(const struct occlude_##list##_arguments *a, size_t first, size_t last) \
	{ \
		struct args args = ARGS_OF(a, tree); \
\
		args.opacity = words; \
		for (size_t i = first; i < last && i < a->n_rays; i++) \
			a->occluded[i] = occluded_of(walk_ray(&args, (uint32_t)i, 1, a->to_lights)); \
	} \
\
	void intersect_##list##_c(const struct intersect_##list##_arguments *a, size_t first, size_t last) \
	{ \
		struct args args = ARGS_OF(a, tree); \
\
		args.last = a->after ? a->last : NULL; \
		for (size_t i = first; i < last && i < a->n_rays; i++) \
			a->hits[i] = walk_ray(&args, (uint32_t)i, 0, 0).hit; \
	}
TWINS(wide, TREE_ROWS, a->opacity)
TWINS(binary, TREE_BINARY, NULL)
TWINS(compressed, TREE_COMPRESSED, NULL)

void occlude_packet_c(const struct occlude_wide_arguments *a, size_t first, size_t last)
{
	occlude_wide_c(a, first * RAYS_PER_ITEM, last * RAYS_PER_ITEM);
}

void intersect_packet_c(const struct intersect_wide_arguments *a, size_t first, size_t last)
{
	intersect_wide_c(a, first * RAYS_PER_ITEM, last * RAYS_PER_ITEM);
}
