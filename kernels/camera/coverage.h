/*
 * GL's coverage rule for one pixel, as specified in kernels/camera/camera.h; scalar. OpenCL C only.
 * kernels/ref/camera.c is the twin.
 */
#pragma once

#include "scene/scene.h"
#include "kernels/shared.h"
#include "kernels/gl/clip.h"

static inline int coverage_culled(uint flags, int counter_clockwise)
{
	const int front = counter_clockwise == !(flags & INSTANCE_FRONT_CW);

	return (flags & (front ? INSTANCE_CULL_FRONT : INSTANCE_CULL_BACK)) != 0;
}

/* Twice the signed area of the triangle a, b and a place, in 1/65536 square pixel. */
static inline long coverage_edge(struct window_vertex a, struct window_vertex b, struct clip_spot at)
{
	return (long)(b.x - a.x) * (at.y - a.y) - (long)(b.y - a.y) * (at.x - a.x);
}

static inline int coverage_inside(struct window_vertex a, struct window_vertex b, int sign, struct clip_spot at)
{
	const long e = sign * coverage_edge(a, b, at);
	const int dx = sign * (b.x - a.x), dy = sign * (b.y - a.y);

	return e > 0 || (e == 0 && (dy < 0 || (dy == 0 && dx > 0)));
}

/* Coverage if all vertices have a place in the window. */
static inline int coverage_placed(struct window_vertex v0, struct window_vertex v1, struct window_vertex v2, uint flags,
                           struct clip_spot at, float *b1, float *b2, float *depth)
{
	const long area = (long)(v1.x - v0.x) * (v2.y - v0.y) - (long)(v2.x - v0.x) * (v1.y - v0.y);
	const int sign = area > 0 ? 1 : -1;
	float inverse;

	if (area == 0 || coverage_culled(flags, sign > 0))
		return 0;
	if (!coverage_inside(v1, v2, sign, at) || !coverage_inside(v2, v0, sign, at) || !coverage_inside(v0, v1, sign, at))
		return 0;
	inverse = 1.0f / (float)area;
	*b1 = (float)coverage_edge(v2, v0, at) * inverse;
	*b2 = (float)coverage_edge(v0, v1, at) * inverse;
	*depth = fmax(fmin(v0.z + (*b1 * (v1.z - v0.z) + *b2 * (v2.z - v0.z)), 1.0f), 0.0f);
	return 1;
}

/* Depth at a pixel as used in comparisons: from vertices that are not snapped. corner: as for clip_depth_plane. */
static inline float coverage_depth(__global const struct view *view, uint height,
                                   const struct clip_corner *const *corner, const struct vec4 *clip, const float *z,
                                   int x, int y, float otherwise)
{
	struct clip_plane plane;

	if (!clip_depth_plane(view, (float)height, corner, clip, z, &plane))
		return otherwise;
	return clamp01(clip_plane_in(&plane, view, (float)height, x, y));
}

/* A vertex lies outside the view volume: test the clipped triangle. i0, i1, i2: indices in clip. */
static inline int coverage_clipped(__global const struct view *view, __global const float *clip, uint height, uint i0,
                                   uint i1, uint i2, uint flags, int exact, int x, int y, float *b1, float *b2,
                                   float *depth)
{
	struct clip_polygon polygon;
	const struct clip_corner *last = &polygon.corner[0];

	clip_triangle(view, (float)height, v4_load(clip + 4 * i0), v4_load(clip + 4 * i1), v4_load(clip + 4 * i2), &polygon);
	for (uint k = 2; k < polygon.n; k++) {
		const struct clip_corner *c = &polygon.corner[k];

		if (!coverage_placed(c[-1].window, c->window, last->window, flags, clip_spot(view, x, y), b1, b2, depth))
			continue;
		if (exact) {
			const struct clip_corner *const corner[3] = { c - 1, c, last };
			const float z[3] = { c[-1].window.z, c->window.z, last->window.z };

			*depth = coverage_depth(view, height, corner, 0, z, x, y, *depth);
		}
		clip_weights(c - 1, c, last, *b1, *b2, b1, b2);
		return 1;
	}
	return 0;
}
