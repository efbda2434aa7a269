/*
 * User clip planes (GL 2.1 sec. 2.12) at one pixel. Mesa's draw module (22.3) clips a triangle by them after the view
 * volume's planes, in the same way (kernels/gl/clip.h), so that new edges run between snapped corners. The test is
 * therefore whether a remaining part covers the pixel, not which side of a plane its centre is on.
 */
#pragma once

#include "kernels/gl/point.h"

#define USERCLIP_CORNERS (CLIP_MAX_CORNERS + SCENE_MAX_CLIP_PLANES)

/* Distances of a triangle's vertices from a plane. */
struct userclip_plane {
	float d[3];
};

static inline struct userclip_plane userclip_plane(const struct point *p, uint32_t i)
{
	struct vec4 plane = v4_load(p->material->clip_plane_eye[i]);
	struct userclip_plane out;

	for (uint32_t k = 0u; k < 3u; k++)
		out.d[k] = v4_dot(plane, point_clip_place(p, k));
	return out;
}

static inline float userclip_distance(const struct userclip_plane *plane, const struct clip_corner *c)
{
	return plane->d[0] * (1.0f - c->b1 - c->b2) + plane->d[1] * c->b1 + plane->d[2] * c->b2;
}

/* The corner of a cut, interpolated from the corner nearer to the plane. d: their distances, one of them negative */
static inline struct clip_corner userclip_cut(GLOBAL const struct view *view, float height, const struct clip_corner *a,
                                              const struct clip_corner *b, float d_a, float d_b)
{
	const int from_b = M_ABS(d_b) < M_ABS(d_a);
	struct clip_corner pool[2], out;
	struct clip_cuts cuts;

	pool[0] = from_b ? *b : *a;
	pool[1] = from_b ? *a : *b;
	cuts.n = 1u;
	cuts.from[0] = 0u;
	cuts.to[0] = 1u;
	cuts.t[0] = from_b ? d_b / (d_b - d_a) : d_a / (d_a - d_b);
	out = clip_cut(pool, &cuts, 0u);
	if (!clip_place_new(view, height, &out)) {
		out.window.x = out.window.y = 0;
		out.window.z = out.window.w_inv = 0.0f;
	}
	return out;
}

/* Clip a polygon of n corners by a plane. @return the number of corners in out */
static inline uint32_t userclip_by(GLOBAL const struct view *view, float height, const struct userclip_plane *plane,
                                   const struct clip_corner *in, uint32_t n, struct clip_corner *out)
{
	uint32_t left = 0u;

	for (uint32_t i = 0u; i < n; i++) {
		const struct clip_corner *a = &in[i], *b = &in[i + 1u < n ? i + 1u : 0u];
		float d_a = userclip_distance(plane, a), d_b = userclip_distance(plane, b);

		if (d_a >= 0.0f && left < USERCLIP_CORNERS)
			out[left++] = *a;
		if ((d_a >= 0.0f) != (d_b >= 0.0f) && left < USERCLIP_CORNERS)
			out[left++] = userclip_cut(view, height, a, b, d_a, d_b);
	}
	return left;
}

/* Clip a fragment's triangle by the view volume. @return the number of corners */
static inline uint32_t userclip_begin(GLOBAL const struct view *view, GLOBAL const struct window_vertex *windows,
                                      const struct point *p, float height, struct clip_corner *out)
{
	struct clip_polygon polygon;

	clip_triangle(view, height, v4_load(p->vertex[0]->clip), v4_load(p->vertex[1]->clip),
	              v4_load(p->vertex[2]->clip), &polygon);
	for (uint32_t i = 0u; i < polygon.n; i++) {
		out[i] = polygon.corner[i];
		if (out[i].number < 3u)
			out[i].window = windows[p->geometry->vertex_first + p->number[out[i].number]];
	}
	return polygon.n;
}

/*
 * 1 if the planes clip away a fragment's triangle at a pixel. Lines and points are clipped when they are made into
 * triangles (tracer/frame/prepare/expand.c).
 *
 * x, y  the pixel, y from the bottom
 */
static inline int userclip_outside(GLOBAL const struct view *view, GLOBAL const struct window_vertex *windows,
                                   const struct point *p, int32_t x, int32_t y, float height)
{
	struct clip_corner corner[2][USERCLIP_CORNERS];
	uint32_t n = 0u, now = 0u;

	if (!p->material->clip_plane_mask || (p->geometry->flags & GEOMETRY_EXPANDED))
		return 0;
	for (uint32_t i = 0u; i < SCENE_MAX_CLIP_PLANES; i++) {
		struct userclip_plane plane;

		if (!(p->material->clip_plane_mask >> i & 1u))
			continue;
		plane = userclip_plane(p, i);
		if (plane.d[0] >= 0.0f && plane.d[1] >= 0.0f && plane.d[2] >= 0.0f)
			continue;
		if (!n)
			n = userclip_begin(view, windows, p, height, corner[now]);
		n = userclip_by(view, height, &plane, corner[now], n, corner[!now]);
		now = !now;
		if (n < 3u)
			return 1;
	}
	for (uint32_t k = 2u; k < n; k++)
		if (clip_covers(corner[now][k - 1u].window, corner[now][k].window, corner[now][0].window, clip_spot(view, x, y)))
			return 0;
	return n != 0u;
}
