/*
 * query_all, query_distance, query_box, query_sphere: scene queries for programs other than a renderer. There is one
 * binary tree with all triangles in one space, each in a single leaf (ACCEL_BVH). The text is for both C and OpenCL C,
 * so the twins are built from it, too. Results are compared with brute force (tests/query/).
 *
 *   all       triangles that a ray hits, by the rule of kernels/rays/rays.h; the nearest `most` of them, sorted by t,
 *             then by number
 *   distance  the point of any triangle that is nearest to a point, at most `most` away
 *   box       first contact of a moving box with a triangle, by separating axes: along each axis the box overlaps the
 *             triangle during an interval, and they meet when the last interval begins, unless another has ended by
 *             then (Ericson 2005, "Real-Time Collision Detection", section 5.5.8). Triangles are surfaces: a body
 *             inside a closed mesh touches nothing
 *   sphere    the same for a sphere: the distance of a moving point from a triangle is a convex function of its path,
 *             so Newton's method along the tangent approaches the contact without passing it
 *
 * For distance, box and sphere, triangles without area count as the segments or points that they are. Between equal
 * answers, the lowest triangle wins. A query with a NaN or an infinite number finds nothing.
 */
#pragma once

#include "kernels/common.h"
#include "kernels/kernels.h"
#include "kernels/rays/rays.h"

#define QUERY_ALL 0u
#define QUERY_DISTANCE 1u
#define QUERY_BOX 2u
#define QUERY_SPHERE 3u

/* Padding of node boxes, as a share of the numbers that give their position: more than the rounding error of an
 * answer. */
#define QUERY_PAD 2e-6f
/* The same for t, and the distance that counts as touching a sphere. */
#define QUERY_SLACK 1e-5f
#define QUERY_TOUCH 1e-6f
/*
 * Possible error of the direction to the nearest point: if an edge is as near as a face apart from rounding, it is the
 * square root of that rounding, divided by the distance. Steps towards a triangle are shortened accordingly, and at
 * least by QUERY_TURN.
 */
#define QUERY_TURN 1e-3f
#define QUERY_ROUNDING 5e-7f
/*
 * Largest distance, as a share of the query's distance, between the foot point on a face and the point that the corner
 * weights give.
 */
#define QUERY_APART 1e-5f
#define QUERY_STEPS 64u

/* State of a query during traversal. */
struct query {
	struct vec3 o, d;    /* point, ray, or path of a body's centre */
	struct vec3 inverse; /* inverse of d */
	struct vec3 size;    /* half extent of a body around its centre */
	float radius;        /* the sphere's radius */
	float t_min;
	float far;           /* cutoff: t, or the distance squared */
	float extent;        /* largest number in the query's coordinates */
	struct vec3 at;      /* distance: the nearest point so far */
	uint32_t primitive;  /* triangle of the best answer so far */
	GLOBAL struct hit *hits; /* all: the nearest `most` hits so far */
	uint32_t most, count;
};

/* 0 also for NaN and for numbers that are too large. */
static inline int query_is_finite(struct vec3 v)
{
	return M_ABS(v.x) < RAYS_RANGE && M_ABS(v.y) < RAYS_RANGE && M_ABS(v.z) < RAYS_RANGE;
}

static inline float query_invert(float d)
{
	return 1.0f / (M_ABS(d) > 1e-20f ? d : d < 0.0f ? -1e-20f : 1e-20f);
}

static inline struct vec3 query_fma(struct vec3 a, float s, struct vec3 b)
{
	return v3(M_FMA(a.x, s, b.x), M_FMA(a.y, s, b.y), M_FMA(a.z, s, b.z));
}

static inline float query_dot(struct vec3 a, struct vec3 b)
{
	return M_FMA(a.z, b.z, M_FMA(a.y, b.y, a.x * b.x));
}

static inline struct vec3 query_cross(struct vec3 a, struct vec3 b)
{
	return v3(M_FMA(a.y, b.z, -(a.z * b.y)), M_FMA(a.z, b.x, -(a.x * b.z)), M_FMA(a.x, b.y, -(a.y * b.x)));
}

/* --- Boxes of nodes ---------------------------------------------------------------------------------------------- */

/* Distances at the two ends of the path's part inside [lo, hi], along one axis. */
static inline void query_slab(float lo, float hi, float o, float inverse, float *enter, float *leave)
{
	const float a = (lo - o) * inverse, b = (hi - o) * inverse;

	*enter = M_MAX(*enter, M_MIN(a, b));
	*leave = M_MIN(*leave, M_MAX(a, b));
}

/* Lower bound for an answer inside a box: t, or the distance squared. Infinite if it cannot count. */
static inline float query_bound(const struct query *q, uint32_t kind, GLOBAL const float *lo, GLOBAL const float *hi)
{
	const struct vec3 least = v3_load(lo), most = v3_load(hi);
	const float pad = QUERY_PAD * (M_MAX(v3_extent(least), v3_extent(most)) + q->extent);
	float enter = q->t_min, leave = q->far;

	if (least.x > most.x)
		return INFINITY;
	if (kind == QUERY_DISTANCE) {
		const float x = M_MAX(M_MAX(least.x - q->o.x, q->o.x - most.x) - pad, 0.0f);
		const float y = M_MAX(M_MAX(least.y - q->o.y, q->o.y - most.y) - pad, 0.0f);
		const float z = M_MAX(M_MAX(least.z - q->o.z, q->o.z - most.z) - pad, 0.0f);
		const float bound = (x * x + y * y + z * z) * (1.0f - QUERY_SLACK);

		return bound <= q->far ? bound : INFINITY;
	}
	query_slab(least.x - q->size.x - pad, most.x + q->size.x + pad, q->o.x, q->inverse.x, &enter, &leave);
	query_slab(least.y - q->size.y - pad, most.y + q->size.y + pad, q->o.y, q->inverse.y, &enter, &leave);
	query_slab(least.z - q->size.z - pad, most.z + q->size.z + pad, q->o.z, q->inverse.z, &enter, &leave);
	return enter <= leave + QUERY_SLACK * M_ABS(leave) ? enter - QUERY_SLACK * M_ABS(enter) : INFINITY;
}

/* --- Triangles --------------------------------------------------------------------------------------------------- */

/* A triangle relative to the query's o. */
struct query_triangle {
	struct vec3 v0, e1, e2;
	uint32_t primitive;
};

/* Parameter of the point nearest to p on an edge from `a` along `e`. */
static inline float query_along(struct vec3 p, struct vec3 a, struct vec3 e)
{
	const float length2 = query_dot(e, e);

	return length2 > 0.0f ? clamp01(query_dot(v3_sub(p, a), e) / length2) : 0.0f;
}

static inline void query_take_nearer(struct vec3 away, struct vec3 *best, float *least)
{
	const float length2 = query_dot(away, away);

	if (length2 < *least) {
		*least = length2;
		*best = away;
	}
}

/*
 * The vector from a triangle's nearest point to p. Edges are tested first, so that triangles without area have an
 * answer.
 */
static inline struct vec3 query_away(const struct query_triangle *t, struct vec3 p)
{
	const struct vec3 side = v3_sub(t->e2, t->e1), from = v3_sub(p, t->v0), n = query_cross(t->e1, t->e2);
	const struct vec3 b = v3_add(t->v0, t->e1);
	const float n2 = query_dot(n, n);
	struct vec3 best = v3_sub(p, query_fma(t->e1, query_along(p, t->v0, t->e1), t->v0));
	float least = query_dot(best, best);

	query_take_nearer(v3_sub(p, query_fma(t->e2, query_along(p, t->v0, t->e2), t->v0)), &best, &least);
	query_take_nearer(v3_sub(p, query_fma(side, query_along(p, b, side), b)), &best, &least);
	if (n2 > 0.0f) {
		const float u = query_dot(query_cross(from, t->e2), n) / n2, v = query_dot(query_cross(t->e1, from), n) / n2;

		if (u >= 0.0f && v >= 0.0f && u + v <= 1.0f) {
			const struct vec3 off = v3_sub(p, query_fma(t->e2, v, query_fma(t->e1, u, t->v0))),
					  across = v3_scale(n, query_dot(from, n) / n2);
			const struct vec3 apart = v3_sub(off, across);

			/*
			 * A needle's normal can be rounded to a different one, so that its plane is nearer than any of its points.
			 */
			query_take_nearer(query_dot(apart, apart) <= QUERY_APART * QUERY_APART * query_dot(off, off) ?
			                          across :
			                          off,
			                  &best, &least);
		}
	}
	return best;
}

static inline void query_try_distance(struct query *q, const struct query_triangle *t)
{
	const struct vec3 away = query_away(t, v3(0, 0, 0));
	const float length2 = query_dot(away, away);

	if (length2 < q->far || (length2 == q->far && t->primitive < q->primitive)) {
		q->far = length2;
		q->at = v3_sub(q->o, away);
		q->primitive = t->primitive;
	}
}

static inline void query_take_contact(struct query *q, float t, uint32_t primitive)
{
	if (t < q->far || (t == q->far && primitive < q->primitive)) {
		q->far = t;
		q->primitive = primitive;
	}
}

static inline void query_try_sphere(struct query *q, const struct query_triangle *triangle)
{
	const float touch = QUERY_TOUCH * (q->radius + q->extent), speed = M_SQRT(query_dot(q->d, q->d));
	const float rounding = QUERY_ROUNDING *
	                       (v3_extent(triangle->v0) + v3_extent(triangle->e1) + v3_extent(triangle->e2));
	float t = 0.0f;

	for (uint32_t i = 0; i < QUERY_STEPS && t <= q->far; i++) {
		const struct vec3 away = query_away(triangle, v3_scale(q->d, t));
		const float distance = M_SQRT(query_dot(away, away)), gap = distance - q->radius;
		const float turn = M_MAX(QUERY_TURN, M_SQRT(rounding / M_MAX(distance, 1e-30f)));
		const float approach = turn * speed * distance - query_dot(away, q->d);

		if (gap <= touch) {
			query_take_contact(q, t, triangle->primitive);
			return;
		}
		if (!(approach > 0.0f))
			return;
		t += gap * distance / approach;
	}
}

/* The interval during which the box and the triangle overlap along an axis, intersected with the interval so far. */
static inline void query_axis(const struct query *q, const struct query_triangle *t, struct vec3 axis, float *enter,
                              float *leave)
{
	const float a = query_dot(t->v0, axis), b = a + query_dot(t->e1, axis), c = a + query_dot(t->e2, axis);
	const float reach = q->size.x * M_ABS(axis.x) + q->size.y * M_ABS(axis.y) + q->size.z * M_ABS(axis.z);
	const float lo = M_MIN(a, M_MIN(b, c)) - reach, hi = M_MAX(a, M_MAX(b, c)) + reach;
	const float speed = query_dot(q->d, axis);

	if (speed == 0.0f) {
		if (lo > 0.0f || hi < 0.0f)
			*leave = -INFINITY;
		return;
	}
	*enter = M_MAX(*enter, (speed > 0.0f ? lo : hi) / speed);
	*leave = M_MIN(*leave, (speed > 0.0f ? hi : lo) / speed);
}

/* Axes perpendicular to an edge of the triangle and one of the box. Almost parallel edges are skipped, as faces are
 * then better axes. */
static inline void query_edge(const struct query *q, const struct query_triangle *t, struct vec3 e, float *enter,
                              float *leave)
{
	const float least = 1e-6f * query_dot(e, e);

	if (e.y * e.y + e.z * e.z > least)
		query_axis(q, t, v3(0, -e.z, e.y), enter, leave);
	if (e.x * e.x + e.z * e.z > least)
		query_axis(q, t, v3(e.z, 0, -e.x), enter, leave);
	if (e.x * e.x + e.y * e.y > least)
		query_axis(q, t, v3(-e.y, e.x, 0), enter, leave);
}

static inline void query_try_box(struct query *q, const struct query_triangle *t)
{
	float enter = 0.0f, leave = 1.0f;

	query_axis(q, t, v3(1, 0, 0), &enter, &leave);
	query_axis(q, t, v3(0, 1, 0), &enter, &leave);
	query_axis(q, t, v3(0, 0, 1), &enter, &leave);
	if (enter > leave)
		return;
	query_axis(q, t, query_cross(t->e1, t->e2), &enter, &leave);
	query_edge(q, t, t->e1, &enter, &leave);
	query_edge(q, t, t->e2, &enter, &leave);
	query_edge(q, t, v3_sub(t->e2, t->e1), &enter, &leave);
	if (enter <= leave)
		query_take_contact(q, enter, t->primitive);
}

/* Insert a hit into the stored ones, if it is among the nearest. */
static inline void query_keep(struct query *q, float t, float u, float v, uint32_t primitive)
{
	uint32_t place = q->count < q->most ? q->count : q->most;

	q->count++;
	if (place == q->most && (place == 0 || q->hits[place - 1].t < t ||
	                         (q->hits[place - 1].t == t && q->hits[place - 1].primitive < primitive)))
		return;
	if (place == q->most)
		place--;
	for (; place > 0 &&
	       (q->hits[place - 1].t > t || (q->hits[place - 1].t == t && q->hits[place - 1].primitive > primitive));
	     place--)
		q->hits[place] = q->hits[place - 1];
	q->hits[place].t = t;
	q->hits[place].b1 = u;
	q->hits[place].b2 = v;
	q->hits[place].instance = 0;
	q->hits[place].primitive = primitive;
}

/* Moeller and Trumbore, as specified in kernels/rays/rays.h. */
static inline void query_try_ray(struct query *q, const struct query_triangle *triangle)
{
	const struct vec3 s = v3(-triangle->v0.x, -triangle->v0.y, -triangle->v0.z);
	const struct vec3 p = query_cross(q->d, triangle->e2), r = query_cross(s, triangle->e1);
	const float inverse = 1.0f / query_dot(triangle->e1, p);
	const float u = query_dot(s, p) * inverse, v = query_dot(q->d, r) * inverse, t = query_dot(triangle->e2, r) * inverse;

	if (u >= -RAYS_EDGE_SLACK && v >= -RAYS_EDGE_SLACK && u + v <= 1 + RAYS_EDGE_SLACK && t >= q->t_min && t <= q->far &&
	    RAYS_FLAT * v3_extent(triangle->e1) * v3_extent(triangle->e2) * (v3_extent(q->d) * M_ABS(inverse)) < 1)
		query_keep(q, t, u, v, triangle->primitive);
}

static inline void query_try(struct query *q, uint32_t kind, GLOBAL const struct triangle *triangle)
{
	struct query_triangle t;

	t.v0 = v3_sub(v3_load(triangle->v0), q->o);
	t.e1 = v3_load(triangle->e1);
	t.e2 = v3_load(triangle->e2);
	t.primitive = triangle->primitive;
	if (kind == QUERY_ALL)
		query_try_ray(q, &t);
	else if (kind == QUERY_DISTANCE)
		query_try_distance(q, &t);
	else if (kind == QUERY_BOX)
		query_try_box(q, &t);
	else
		query_try_sphere(q, &t);
}

/* --- The walk ---------------------------------------------------------------------------------------------------- */

/* Traverse the tree, nearer sides first. */
static inline void query_walk(struct query *q, uint32_t kind, GLOBAL const struct node2 *nodes,
                              GLOBAL const struct triangle *triangles)
{
	uint32_t stack[BVH_MAX_DEPTH + 1], depth = 0, at = 0;
	float bounds[BVH_MAX_DEPTH + 1];

	for (;;) {
		GLOBAL const struct node2 *node = &nodes[at];
		float bound[2];
		uint32_t first, next = SCENE_NONE;

		bound[0] = query_bound(q, kind, node->lo[0], node->hi[0]);
		bound[1] = query_bound(q, kind, node->lo[1], node->hi[1]);
		first = bound[1] < bound[0];
		for (uint32_t i = 0; i < 2; i++) {
			const uint32_t side = i ? 1 - first : first;

			if (!(bound[side] <= q->far))
				continue;
			for (uint32_t k = 0; k < node->count[side]; k++)
				query_try(q, kind, &triangles[node->child[side] + k]);
			if (node->count[side])
				continue;
			if (next == SCENE_NONE) {
				next = node->child[side];
			} else {
				bounds[depth] = bound[side];
				stack[depth++] = node->child[side];
			}
		}
		while (next == SCENE_NONE && depth > 0)
			if (bounds[--depth] <= q->far)
				next = stack[depth];
		if (next == SCENE_NONE)
			return;
		at = next;
	}
}

/* Start a query along a path. @return 0: it finds nothing by definition */
static inline int query_start(struct query *q, GLOBAL const float *o, GLOBAL const float *d)
{
	q->o = v3_load(o);
	q->d = v3_load(d);
	q->inverse = v3(query_invert(q->d.x), query_invert(q->d.y), query_invert(q->d.z));
	q->size = v3(0, 0, 0);
	q->radius = 0;
	q->t_min = 0;
	q->far = 1;
	q->extent = v3_extent(q->o) + v3_extent(q->d);
	q->at = q->o;
	q->primitive = SCENE_NONE;
	q->hits = 0;
	q->most = q->count = 0;
	return query_is_finite(q->o) && query_is_finite(q->d) &&
	       query_is_finite(v3(q->o.x * q->inverse.x, q->o.y * q->inverse.y, q->o.z * q->inverse.z));
}

static inline void query_all_item(const struct query_all_arguments *a, uint32_t i)
{
	GLOBAL const struct ray *ray = &a->rays[i];
	struct query q;
	const int is_finite = query_start(&q, ray->o, ray->d);

	q.t_min = ray->t_min;
	q.far = ray->t_max;
	q.extent = v3_extent(q.o);
	q.hits = a->hits + (size_t)i * a->most;
	q.most = a->most;
	if (is_finite && q.t_min <= q.far)
		query_walk(&q, QUERY_ALL, a->nodes, a->triangles);
	a->counts[i] = q.count;
}

static inline void query_distance_item(const struct query_distance_arguments *a, uint32_t i)
{
	GLOBAL const struct query_point *point = &a->points[i];
	GLOBAL struct query_nearest *out = &a->nearest[i];
	struct query q;
	const int is_finite = query_start(&q, point->p, point->p);

	q.extent = v3_extent(q.o);
	q.far = point->most * point->most;
	if (is_finite && point->most >= 0.0f)
		query_walk(&q, QUERY_DISTANCE, a->nodes, a->triangles);
	out->distance = q.primitive == SCENE_NONE ? INFINITY : M_SQRT(q.far);
	v3_store(out->p, q.at);
	out->primitive = q.primitive;
}

static inline void query_contact(GLOBAL const struct query_body *body, uint32_t kind, GLOBAL const struct node2 *nodes,
                           GLOBAL const struct triangle *triangles, GLOBAL struct query_contact *out)
{
	struct query q;
	const int is_finite = query_start(&q, body->centre, body->move);

	q.radius = body->size[0];
	q.size = kind == QUERY_SPHERE ? v3(q.radius, q.radius, q.radius) : v3_load(body->size);
	if (is_finite && query_is_finite(q.size) && q.size.x >= 0.0f && q.size.y >= 0.0f && q.size.z >= 0.0f)
		query_walk(&q, kind, nodes, triangles);
	out->t = q.primitive == SCENE_NONE ? INFINITY : q.far;
	out->primitive = q.primitive;
}

static inline void query_box_item(const struct query_box_arguments *a, uint32_t i)
{
	query_contact(&a->bodies[i], QUERY_BOX, a->nodes, a->triangles, &a->contacts[i]);
}

static inline void query_sphere_item(const struct query_sphere_arguments *a, uint32_t i)
{
	query_contact(&a->bodies[i], QUERY_SPHERE, a->nodes, a->triangles, &a->contacts[i]);
}
