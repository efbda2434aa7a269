/*
 * From clip space to the window (GL 2.1 sec. 2.11, 2.12): window positions of vertices, and clipping of triangles that
 * leave the view volume.
 *
 * Triangles are clipped as in Mesa's draw module (22.3): plane by plane in single precision, and the result is split
 * into a fan around its first corner. New corners are snapped to 1/256 pixel like all others, and edges and depth are
 * those of the parts. The difference is visible on a wall that reaches from the horizon to behind the viewer.
 */
#pragma once

#include "kernels/common.h"

/* Window coordinates beyond this many pixels are not stored in 1/256 pixel. */
#define CLIP_SAFE_PIXELS 16384.0f
#define CLIP_FLOAT_MAX 3.402823466e38f
#define CLIP_PLANES 6
#define CLIP_MAX_CORNERS 9 /* three from the triangle, and one for each plane */
#define CLIP_MAX_CUTS (2 * CLIP_PLANES)

#ifdef __OPENCL_VERSION__
typedef long clip_area;
#else
typedef int64_t clip_area;
#endif

/*
 * How new corners were made, in this order: corner 3 + i is at t[i] between corners from[i] and to[i]; corners 0 to 2
 * are the triangle's. Values that Mesa interpolates are interpolated the same way.
 */
struct clip_cuts {
	uint32_t n, from[CLIP_MAX_CUTS], to[CLIP_MAX_CUTS];
	float t[CLIP_MAX_CUTS];
};

/* A corner of a clipped triangle. */
struct clip_corner {
	struct vec4 clip;
	uint32_t number;             /* 0 to 2: the triangle's; higher: see struct clip_cuts */
	float b1, b2;                /* weights of the triangle's vertices 1 and 2, in the volume */
	float place[2];              /* in pixels, not snapped, y from the top */
	struct window_vertex window;
};

struct clip_polygon {
	uint32_t n; /* number of corners; 0: nothing is left */
	struct clip_corner corner[CLIP_MAX_CORNERS];
	struct clip_cuts cuts;
};

/* --- The window -------------------------------------------------------------------------------------------------- */

#include "kernels/gl/clip_lanes.h"

/* A window position, in 1/256 pixel, y from the bottom. */
struct clip_spot {
	clip_area x, y;
};

/* A view's sample position in a pixel. */
static inline struct clip_spot clip_spot(GLOBAL const struct view *view, int32_t x, int32_t y)
{
	struct clip_spot at;

	at.x = (clip_area)x * 256 + 128 + view->sample[0];
	at.y = (clip_area)y * 256 + 128 + view->sample[1];
	return at;
}

/*
 * Origin of the coordinates of planes: the centre of the first pixel, as in llvmpipe, or the window's corner if pixels
 * have several samples (and none at the centre).
 */
static inline float clip_origin(GLOBAL const struct view *view)
{
	return view->sample[0] | view->sample[1] ? 0.0f : 0.5f;
}

/* A function that is linear over a triangle of the window; x and y are in pixels from clip_origin, y from the top. */
struct clip_plane {
	float origin, along_x, along_y;
};

/* Twice the signed area of three places. */
static inline float clip_place_area(const float *px, const float *py)
{
	return (px[0] - px[1]) * (py[2] - py[0]) - (px[2] - px[0]) * (py[0] - py[1]);
}

/* So thin that only its snapped form counts, which determined the coverage. */
static inline int clip_is_sliver(float area)
{
	return !(M_ABS(area) > 1.0e-6f);
}

/*
 * A triangle as llvmpipe sets it up: its vertices ordered to run counter-clockwise (y from the top), and two edges.
 * Positions are not snapped and relative to clip_origin.
 */
struct clip_edges {
	int turned; /* 1: vertices 0 and 1 are swapped */
	float x, y, dx01, dy01, dx20, dy20, one_over_area; /* x, y: position of the first vertex */
};

/* The first and the second of three vertex values, selected rather than indexed, so that the array can stay in
 * registers. */
static inline float clip_first(const struct clip_edges *e, const float *value)
{
	return e->turned ? value[1] : value[0];
}

static inline float clip_second(const struct clip_edges *e, const float *value)
{
	return e->turned ? value[0] : value[1];
}

static inline struct clip_edges clip_edges_of(const float *px, const float *py)
{
	struct clip_edges e;

	e.turned = clip_place_area(px, py) < 0.0f;
	e.x = clip_first(&e, px);
	e.y = clip_first(&e, py);
	e.dx01 = e.x - clip_second(&e, px);
	e.dy01 = e.y - clip_second(&e, py);
	e.dx20 = px[2] - e.x;
	e.dy20 = py[2] - e.y;
	e.one_over_area = 1.0f / (e.dx01 * e.dy20 - e.dx20 * e.dy01);
	return e;
}

/* The plane through a value at each vertex, in llvmpipe's order of operations, starting at the first vertex. */
static inline struct clip_plane clip_plane_through(const struct clip_edges *e, const float *value)
{
	const float first = clip_first(e, value), v01 = first - clip_second(e, value), v20 = value[2] - first;
	struct clip_plane out;

	out.along_x = v01 * (e->dy20 * e->one_over_area) - v20 * (e->dy01 * e->one_over_area);
	out.along_y = v20 * (e->dx01 * e->one_over_area) - v01 * (e->dx20 * e->one_over_area);
	out.origin = first - (out.along_x * e->x + out.along_y * e->y);
	return out;
}

static inline float clip_plane_at(const struct clip_plane *p, float x, float y)
{
	return M_FMA(p->along_y, y, M_FMA(p->along_x, x, p->origin));
}

/* Distance from clip_origin to the sample position in a pixel, along one axis. sample: of the view; negated for y. */
static inline float clip_from_origin(GLOBAL const struct view *view, int32_t pixel, int32_t sample)
{
	return (float)pixel + (0.5f - clip_origin(view)) + (float)sample * 0.00390625f;
}

/* A plane's value at the sample position in a pixel; y from the bottom. */
static inline float clip_plane_in(const struct clip_plane *p, GLOBAL const struct view *view, float height, int32_t x,
                                  int32_t y)
{
	return clip_plane_at(p, clip_from_origin(view, x, view->sample[0]),
	                     clip_from_origin(view, (int32_t)height - 1 - y, -view->sample[1]));
}

/* --- Cutting ----------------------------------------------------------------------------------------------------- */

static inline float clip_distance(struct vec4 c, uint32_t plane)
{
	switch (plane) {
	case 0: return c.w - c.x;
	case 1: return c.x + c.w;
	case 2: return c.w - c.y;
	case 3: return c.y + c.w;
	case 4: return c.z + c.w;
	default: return c.w - c.z;
	}
}

static inline float clip_between(float from, float to, float t)
{
	return from + t * (to - from);
}

/* The new corner of a cut. */
static inline struct clip_corner clip_cut(const struct clip_corner *pool, const struct clip_cuts *cuts, uint32_t cut)
{
	const struct clip_corner *from = &pool[cuts->from[cut]], *to = &pool[cuts->to[cut]];
	const float t = cuts->t[cut];
	struct clip_corner out;

	out.clip = v4(clip_between(from->clip.x, to->clip.x, t), clip_between(from->clip.y, to->clip.y, t),
	              clip_between(from->clip.z, to->clip.z, t), clip_between(from->clip.w, to->clip.w, t));
	out.number = 3u + cut;
	out.b1 = clip_between(from->b1, to->b1, t);
	out.b2 = clip_between(from->b2, to->b2, t);
	return out;
}

/* Window position of a new corner; unlike for vertices, without fused multiplications. @return 0: it has no place */
static inline int clip_place_new(GLOBAL const struct view *view, float height, struct clip_corner *c)
{
	float near = view->depth_range[0], far = view->depth_range[1], w_inv = 1.0f / c->clip.w;

	c->place[0] = c->clip.x * w_inv * (view->viewport[2] * 0.5f) + (view->viewport[0] + view->viewport[2] * 0.5f);
	c->place[1] = c->clip.y * w_inv * (-view->viewport[3] * 0.5f) +
	              (height - (view->viewport[1] + view->viewport[3] * 0.5f));
	if (!(c->clip.w > 0.0f) || !clip_is_safe(c->place))
		return 0;
	c->window = clip_snap(c->place, c->clip.z * w_inv * ((far - near) * 0.5f) + (far + near) * 0.5f, w_inv, height);
	return 1;
}

/* Clip a triangle by the view volume. Its parts are corners k - 1, k and 0 for k from 2 on. */
static inline void clip_triangle(GLOBAL const struct view *view, float height, struct vec4 c0, struct vec4 c1,
                                 struct vec4 c2, struct clip_polygon *out)
{
	struct clip_corner pool[3 + CLIP_MAX_CUTS];
	struct clip_cuts *cuts = &out->cuts;
	uint32_t lists[2][CLIP_MAX_CORNERS + 1], n = 3u, now = 0u;
	uint32_t outside0 = clip_outside(c0), outside1 = clip_outside(c1), outside2 = clip_outside(c2);

	out->n = cuts->n = 0u;
	if (outside0 & outside1 & outside2)
		return;
	for (uint32_t i = 0u; i < 3u; i++) {
		pool[i].clip = i == 0u ? c0 : i == 1u ? c1 : c2;
		pool[i].number = i;
		pool[i].b1 = i == 1u ? 1.0f : 0.0f;
		pool[i].b2 = i == 2u ? 1.0f : 0.0f;
		lists[0][i] = i;
	}
	for (uint32_t plane = 0u; plane < CLIP_PLANES; plane++) {
		uint32_t n_left = 0u, last = lists[now][0];
		float d_last = clip_distance(pool[last].clip, plane);

		if (!((outside0 | outside1 | outside2) >> plane & 1u))
			continue;
		lists[now][n] = last;
		for (uint32_t i = 1u; i <= n; i++) {
			uint32_t next = lists[now][i];
			float d = clip_distance(pool[next].clip, plane);
			int crosses = d_last >= 0.0f ? d < 0.0f : !(d < 0.0f);

			if (n_left + 2u > CLIP_MAX_CORNERS + 1u || (crosses && cuts->n == CLIP_MAX_CUTS) ||
			    !(M_ABS(d) <= CLIP_FLOAT_MAX))
				return; /* infinite, NaN, or crossing a plane repeatedly because of rounding */
			if (d_last >= 0.0f)
				lists[!now][n_left++] = last;
			if (crosses) {
				/* interpolate from the corner nearer to the plane */
				int from_next = d < 0.0f ? -d < d_last : !(-d_last < d);

				cuts->from[cuts->n] = from_next ? next : last;
				cuts->to[cuts->n] = from_next ? last : next;
				cuts->t[cuts->n] = from_next ? d / (d - d_last) : -d_last / (d - d_last);
				pool[3u + cuts->n] = clip_cut(pool, cuts, cuts->n);
				lists[!now][n_left++] = 3u + cuts->n++;
			}
			last = next;
			d_last = d;
		}
		n = n_left;
		now = !now;
		if (n < 3u || n > CLIP_MAX_CORNERS)
			return;
	}
	for (uint32_t i = 0u; i < n; i++) {
		struct clip_corner *c = &out->corner[i];

		*c = pool[lists[now][i]];
		if (lists[now][i] < 3u) {
			clip_place(view, c->clip, height, c->place);
			c->window = clip_window(view, c->clip, height);
			if (!(c->window.w_inv > 0.0f))
				return;
		} else if (!clip_place_new(view, height, c)) {
			return;
		}
	}
	out->n = n;
}

/* --- Its parts --------------------------------------------------------------------------------------------------- */

/* The triangle under a fragment, or the part of a clipped one that covers its pixel: the source of interpolated
 * attributes. */
struct clip_setup {
	struct clip_corner corner[3];
	float px[3], py[3]; /* window positions, relative to clip_origin */
	struct clip_edges edges;
	struct clip_plane w_inv;
	struct clip_cuts cuts;
};

/*
 * Weights of the triangle's vertices 1 and 2 in the volume, from screen weights in one of its parts. b1, b2: of the
 * part's corners 1 and 2
 */
static inline void clip_weights(const struct clip_corner *v0, const struct clip_corner *v1,
                                const struct clip_corner *v2, float b1, float b2, float *out1, float *out2)
{
	float p0 = (1.0f - b1 - b2) * v0->window.w_inv, p1 = b1 * v1->window.w_inv, p2 = b2 * v2->window.w_inv;
	float sum = p0 + p1 + p2;

	*out1 = (p0 * v0->b1 + p1 * v1->b1 + p2 * v2->b1) / sum;
	*out2 = (p0 * v0->b2 + p1 * v1->b2 + p2 * v2->b2) / sum;
}

static inline int clip_inside(struct window_vertex a, struct window_vertex b, int sign, struct clip_spot at)
{
	clip_area dx = (clip_area)sign * (b.x - a.x), dy = (clip_area)sign * (b.y - a.y);
	clip_area e = dx * (at.y - a.y) - dy * (at.x - a.x);

	return e > 0 || (e == 0 && (dy < 0 || (dy == 0 && dx > 0)));
}

/* 1 if a part covers a place (kernels/camera/camera.h). */
static inline int clip_covers(struct window_vertex v0, struct window_vertex v1, struct window_vertex v2,
                              struct clip_spot at)
{
	clip_area area = (clip_area)(v1.x - v0.x) * (v2.y - v0.y) - (clip_area)(v2.x - v0.x) * (v1.y - v0.y);
	int sign = area > 0 ? 1 : -1;

	return area != 0 && clip_inside(v0, v1, sign, at) && clip_inside(v1, v2, sign, at) && clip_inside(v2, v0, sign, at);
}

/*
 * The plane of a triangle's depth. corner: NULL, or its three corners if it is part of a clipped triangle; otherwise
 * clip[] and the windows' z are used. @return 0: a sliver
 */
static inline int clip_depth_plane(GLOBAL const struct view *view, float height,
                                   const struct clip_corner *const *corner, const struct vec4 *clip, const float *z,
                                   struct clip_plane *plane)
{
	float px[3], py[3], place[2];
	struct clip_edges edges;

	for (int i = 0; i < 3; i++) {
		if (corner) {
			place[0] = corner[i]->place[0];
			place[1] = corner[i]->place[1];
		} else {
			clip_place(view, clip[i], height, place);
		}
		px[i] = place[0] - clip_origin(view);
		py[i] = place[1] - clip_origin(view);
	}
	if (clip_is_sliver(clip_place_area(px, py)))
		return 0;
	edges = clip_edges_of(px, py);
	*plane = clip_plane_through(&edges, z);
	return 1;
}
