/*
 * GL's coverage rule for one pixel, as kernels/camera.h says; scalar. OpenCL C only. kernels/ref/camera.c is the twin.
 */
#ifndef KERNELS_COVERAGE_H
#define KERNELS_COVERAGE_H

#include "replay/scene.h"
#include "kernels/shared.h"

inline int coverage_culled(uint flags, int counter_clockwise)
{
	const int front = counter_clockwise == !(flags & INSTANCE_FRONT_CW);

	return (flags & (front ? INSTANCE_CULL_FRONT : INSTANCE_CULL_BACK)) != 0;
}

/* Twice the signed area of a -> b -> the pixel centre, in 1/65536 square pixel. */
inline long coverage_edge(struct window_vertex a, struct window_vertex b, int x, int y)
{
	return (long)(b.x - a.x) * ((long)y * 256 + 128 - a.y) - (long)(b.y - a.y) * ((long)x * 256 + 128 - a.x);
}

inline int coverage_inside(struct window_vertex a, struct window_vertex b, int sign, int x, int y)
{
	const long e = sign * coverage_edge(a, b, x, y);
	const int dx = sign * (b.x - a.x), dy = sign * (b.y - a.y);

	return e > 0 || (e == 0 && (dy < 0 || (dy == 0 && dx > 0)));
}

/* All vertices have a place in the window. */
inline int coverage_placed(struct window_vertex v0, struct window_vertex v1, struct window_vertex v2, uint flags, int x,
                           int y, float *b1, float *b2, float *depth)
{
	const long area = (long)(v1.x - v0.x) * (v2.y - v0.y) - (long)(v2.x - v0.x) * (v1.y - v0.y);
	const int sign = area > 0 ? 1 : -1;
	float inverse;

	if (area == 0 || coverage_culled(flags, sign > 0))
		return 0;
	if (!coverage_inside(v1, v2, sign, x, y) || !coverage_inside(v2, v0, sign, x, y) ||
	    !coverage_inside(v0, v1, sign, x, y))
		return 0;
	inverse = 1.0f / (float)area;
	*b1 = (float)coverage_edge(v2, v0, x, y) * inverse;
	*b2 = (float)coverage_edge(v0, v1, x, y) * inverse;
	*depth = fmax(fmin(v0.z + (*b1 * (v1.z - v0.z) + *b2 * (v2.z - v0.z)), 1.0f), 0.0f);
	return 1;
}

/*
 * The homogeneous edge a -> b at the pixel centre, which is the origin: X, Y are window coordinates times w. 0 where the
 * centre is outside of it, else *weight.
 */
inline int coverage_clipped_edge(struct window_vertex va, struct window_vertex vb, float Xa, float Ya, float wa, float Xb,
                                 float Yb, float wb, float sign, int x, int y, float *weight)
{
	const float e = sign * (Xa * Yb - Xb * Ya);
	const float along_x = sign * (Ya * wb - Yb * wa), along_y = sign * (wa * Xb - wb * Xa);

	*weight = e > 0 ? e : 0;
	if (va.w_inv > 0 && vb.w_inv > 0)
		return coverage_inside(va, vb, sign > 0 ? 1 : -1, x, y);
	return e > 0 || (e == 0 && (along_x > 0 || (along_x == 0 && along_y > 0)));
}

/* A vertex has none. i0, i1, i2: places in window and clip. */
inline int coverage_clipped(__global const struct view *view, __global const struct window_vertex *window,
                            __global const float *clip, uint i0, uint i1, uint i2, uint flags, int x, int y, float *b1,
                            float *b2, float *depth)
{
	const float4 c0 = vload4(i0, clip), c1 = vload4(i1, clip), c2 = vload4(i2, clip);
	const struct window_vertex v0 = window[i0], v1 = window[i1], v2 = window[i2];
	const float half_w = 0.5f * view->viewport[2], half_h = 0.5f * view->viewport[3];
	const float origin_x = view->viewport[0] + half_w - ((float)x + 0.5f);
	const float origin_y = view->viewport[1] + half_h - ((float)y + 0.5f);
	const float det = c0.w * (c1.x * c2.y - c2.x * c1.y) + c1.w * (c2.x * c0.y - c0.x * c2.y) +
	                  c2.w * (c0.x * c1.y - c1.x * c0.y);
	const float sign = det > 0 ? 1.0f : -1.0f;
	const float X0 = c0.x * half_w + c0.w * origin_x, Y0 = c0.y * half_h + c0.w * origin_y;
	const float X1 = c1.x * half_w + c1.w * origin_x, Y1 = c1.y * half_h + c1.w * origin_y;
	const float X2 = c2.x * half_w + c2.w * origin_x, Y2 = c2.y * half_h + c2.w * origin_y;
	float weight0, weight1, weight2, sum, b0, z, w;

	if (!(det != 0) || coverage_culled(flags, det > 0))
		return 0;
	if (!coverage_clipped_edge(v1, v2, X1, Y1, c1.w, X2, Y2, c2.w, sign, x, y, &weight0) ||
	    !coverage_clipped_edge(v2, v0, X2, Y2, c2.w, X0, Y0, c0.w, sign, x, y, &weight1) ||
	    !coverage_clipped_edge(v0, v1, X0, Y0, c0.w, X1, Y1, c1.w, sign, x, y, &weight2))
		return 0;
	sum = weight0 + weight1 + weight2;
	if (!(sum > 0))
		return 0;
	*b1 = weight1 / sum;
	*b2 = weight2 / sum;
	b0 = 1.0f - *b1 - *b2;
	z = b0 * c0.z + *b1 * c1.z + *b2 * c2.z;
	w = b0 * c0.w + *b1 * c1.w + *b2 * c2.w;
	if (!(z >= -w && z <= w && w > 0))
		return 0;
	*depth = view->depth_range[0] + (view->depth_range[1] - view->depth_range[0]) * (0.5f * (z / w) + 0.5f);
	*depth = fmax(fmin(*depth, 1.0f), 0.0f);
	return 1;
}

#endif
