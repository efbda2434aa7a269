/*
 * Sets up sixteen triangles at once for a tile's pixels, one triangle per lane: finds which of them the tile can see,
 * and their edges and depths for rows of pixels. OpenCL C only.
 *
 * A tile covers few pixels of each triangle, so setting up a triangle costs as much as drawing its pixels.
 */
#pragma once

#include "scene/scene.h"
#include "kernels/camera/camera.h"
#include "kernels/camera/coverage.h"
#include "kernels/rays/gather.h"
#include "kernels/rays/lanes.h"

/* Window positions of the corners of sixteen triangles. */
struct batch_corners {
	packi x[3], y[3];             /* 1/256 pixel, y from the bottom */
	packf z[3];
	packf place_x[3], place_y[3]; /* not snapped, in pixels from clip_origin, y from the top */
};

/*
 * Edge i is opposite corner i, oriented so that triangles run counter-clockwise. It is described by its function at a
 * pixel and the function's steps to the right and up. The function is exact in 64 bits. Its integer part needs only 32,
 * because it is clamped to a range where steps inside a tile cannot change its sign.
 */
struct batch {
	packi whole[3]; /* (the function at the tile's first pixel - (1 if the edge itself is outside)) / 256 */
	packi step_x[3], step_y[3];   /* in 1/256 square pixel per pixel */
	long16 value[2];              /* edges 1 and 2 at the tile's first pixel, exact, in 1/65536 square pixel */
	packi small;                  /* lanes whose functions fit 32 bits everywhere inside the triangle */
	packi rest[2];                /* for small lanes: the function is 256 whole + rest */
	packf inverse;                /* 1 / twice the area, in the unit of value */
	packi x_first, x_last, y_first, y_last; /* the tile's pixels within the triangle's box */
	packf z, along_b1, along_b2;  /* depth as a function of weights */
	packi exact;                  /* lanes whose depth comes from the plane below; the others are slivers */
	packf origin, along_x, along_y;
};

/*
 * Load the corners from the vertex tables.
 * @return the lanes whose three corners all have a place in the window; the others are undefined
 */
WIDE_VECTORS static inline packi batch_load(__global const struct view *view, float height,
                                            __global const struct window_vertex *window, __global const float *clip,
                                            const packu *vertex, struct batch_corners *out)
{
	const float half_x = view->viewport[2] * 0.5f, half_y = -view->viewport[3] * 0.5f;
	const float middle_x = view->viewport[0] + view->viewport[2] * 0.5f;
	const float middle_y = height - (view->viewport[1] + view->viewport[3] * 0.5f);
	packi placed = -1;

	for (int i = 0; i < 3; i++) {
		packf in_window[4], in_clip[4];

		pack_gather((__global const float *)window, vertex[i], in_window);
		pack_gather(clip, vertex[i], in_clip);
		placed &= in_window[3] > 0.0f;
		out->x[i] = as_int16(in_window[0]);
		out->y[i] = as_int16(in_window[1]);
		out->z[i] = in_window[2];
		/* As clip_place, but 1 / w is already known. */
		out->place_x[i] = fma((packf)(half_x), in_clip[0] * in_window[3], (packf)(middle_x)) - clip_origin(view);
		out->place_y[i] = fma((packf)(half_y), in_clip[1] * in_window[3], (packf)(middle_y)) - clip_origin(view);
	}
	return placed;
}

/* clip_depth_plane for all lanes. */
WIDE_VECTORS static inline void batch_depth(const struct batch_corners *v, struct batch *out)
{
	const packf *px = v->place_x, *py = v->place_y, *z = v->z;
	const packf area = (px[0] - px[1]) * (py[2] - py[0]) - (px[2] - px[0]) * (py[0] - py[1]);
	const packi turned = area < 0.0f;
	const packf x = select(px[0], px[1], turned), y = select(py[0], py[1], turned), first = select(z[0], z[1], turned);
	const packf dx01 = x - select(px[1], px[0], turned), dy01 = y - select(py[1], py[0], turned);
	const packf dx20 = px[2] - x, dy20 = py[2] - y;
	const packf v01 = first - select(z[1], z[0], turned), v20 = z[2] - first;
	const packf one_over_area = 1.0f / (dx01 * dy20 - dx20 * dy01);

	out->exact = fabs(area) > 1.0e-6f;
	out->along_x = v01 * (dy20 * one_over_area) - v20 * (dy01 * one_over_area);
	out->along_y = v20 * (dx01 * one_over_area) - v01 * (dx20 * one_over_area);
	out->origin = first - (out->along_x * x + out->along_y * y);
	out->z = z[0];
	out->along_b1 = z[1] - z[0];
	out->along_b2 = z[2] - z[0];
}

/* Edge i, from corner a to corner b. sign: all ones to reverse it. @return its function at `at`, exact */
WIDE_VECTORS static inline long16 batch_edge(const struct batch_corners *v, int i, int a, int b, packi turned,
                                             struct clip_spot at, struct batch *out)
{
	const packi dx = ((v->x[b] - v->x[a]) ^ turned) - turned, dy = ((v->y[b] - v->y[a]) ^ turned) - turned;
	const long16 value = convert_long16(dx) * convert_long16((int)at.y - v->y[a]) -
	                     convert_long16(dy) * convert_long16((int)at.x - v->x[a]);
	const packi owned = (dy < 0) | ((dy == 0) & (dx > 0));

	out->step_x[i] = -dy;
	out->step_y[i] = dx;
	out->whole[i] = convert_int16(clamp((value + convert_long16(~owned)) >> 8, (long16)(-(1l << 30)), (long16)(1l << 30)));
	if (i)
		out->rest[i - 1] = ((convert_int16(value) + ~owned) & 255) - ~owned;
	return value;
}

/*
 * Depths beyond which nothing is visible: for each of the tile's sixteen cells of 8 x 8 pixels, row by row, and for the
 * whole tile.
 */
struct batch_far {
	packf cells;
	float all;
};

/*
 * Lanes that are hidden everywhere in their box. A plane's values at the box's corners bound its values inside,
 * rounding included.
 * @param x, y  where the view looks in the tile's first pixel, in the planes' coordinates
 */
WIDE_VECTORS static inline packi batch_hidden(const struct batch *s, const struct batch_far *far, float x, float y)
{
	const packf left = fma(s->along_x, x + convert_float16(s->x_first), s->origin);
	const packf nearest = pack_min(left, fma(s->along_x, x + convert_float16(s->x_last), s->origin));
	const packf low = fma(s->along_y, y - convert_float16(s->y_first), nearest);
	const packf depth = pack_min(pack_min(low, fma(s->along_y, y - convert_float16(s->y_last), nearest)), (packf)(1));
	const packi x0 = s->x_first >> 3, x1 = s->x_last >> 3, y0 = s->y_first >> 3, y1 = s->y_last >> 3;
	const packf below = pack_max(pack_pick(far->cells, 4 * y0 + x0), pack_pick(far->cells, 4 * y0 + x1));
	const packf above = pack_max(pack_pick(far->cells, 4 * y1 + x0), pack_pick(far->cells, 4 * y1 + x1));
	const packf farthest = select(pack_max(below, above), (packf)(far->all), (x1 - x0 > 1) | (y1 - y0 > 1));

	/* A few steps of depth behind, so that draw order cannot matter. */
	return s->exact & (depth > farthest + 3e-7f);
}

/* Lanes where some pixel of the box may be on the inner side of edge i, judging by the box's corners. */
WIDE_VECTORS static inline packi batch_reaches(const struct batch *s, int i)
{
	return s->whole[i] + max(s->step_x[i] * s->x_first, s->step_x[i] * s->x_last) +
	       max(s->step_y[i] * s->y_first, s->step_y[i] * s->y_last) >= 0;
}

/*
 * @param height  of the drawable
 * @param x, y    the tile's first pixel
 * @param flags   the instance's: which faces are culled
 * @param lanes   lanes to set up, all ones each
 * @param far     farthest depths of the tile
 * @return a bit for each triangle that may be visible in the tile
 */
WIDE_VECTORS INLINED uint batch_set_up(__global const struct view *view, uint height, int x, int y, uint flags,
                                       const struct batch_corners *v, packi lanes, const struct batch_far *far,
                                       struct batch *out)
{
	const struct clip_spot at = clip_spot(view, x, y);
	const packi x_first = (min(min(v->x[0], v->x[1]), v->x[2]) + (255 - (int)at.x)) >> 8;
	const packi x_last = (max(max(v->x[0], v->x[1]), v->x[2]) - (int)at.x) >> 8;
	const packi y_first = (min(min(v->y[0], v->y[1]), v->y[2]) + (255 - (int)at.y)) >> 8;
	const packi y_last = (max(max(v->y[0], v->y[1]), v->y[2]) - (int)at.y) >> 8;
	const long16 area = convert_long16(v->x[1] - v->x[0]) * convert_long16(v->y[2] - v->y[0]) -
	                    convert_long16(v->x[2] - v->x[0]) * convert_long16(v->y[1] - v->y[0]);
	const long16 sign = area >> 63, size = (area ^ sign) - sign;
	const packi clockwise = convert_int16(sign);

	lanes &= (x_first <= x_last) & (x_last >= 0) & (x_first < CAMERA_TILE) & (y_first <= y_last) & (y_last >= 0) &
	         (y_first < CAMERA_TILE) & convert_int16(area != 0l);
	if (coverage_culled(flags, 1))
		lanes &= clockwise;
	if (coverage_culled(flags, 0))
		lanes &= ~clockwise;
	if (!any_pack(lanes))
		return 0;
	out->x_first = max(x_first, (packi)(0));
	out->x_last = min(x_last, (packi)(CAMERA_TILE - 1));
	out->y_first = max(y_first, (packi)(0));
	out->y_last = min(y_last, (packi)(CAMERA_TILE - 1));
	batch_edge(v, 0, 1, 2, clockwise, at, out);
	out->value[0] = batch_edge(v, 1, 2, 0, clockwise, at, out);
	out->value[1] = batch_edge(v, 2, 0, 1, clockwise, at, out);
	lanes &= batch_reaches(out, 0) & batch_reaches(out, 1) & batch_reaches(out, 2);
	out->small = convert_int16(size < (1l << 28));
	out->inverse = 1.0f / convert_float16(size);
	batch_depth(v, out);
	lanes &= ~batch_hidden(out, far, clip_from_origin(view, x, view->sample[0]),
	                       clip_from_origin(view, (int)height - 1 - y, -view->sample[1]));
	return pack_bits(lanes);
}
