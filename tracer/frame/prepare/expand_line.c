#include "tracer/frame/prepare/expand_line.h"

#include <math.h>
#include <string.h>

#include "base/err.h"
#include "scene/mesa.h"
#include "tracer/frame/prepare/expand_quad.h"

/* Offset of a coordinate from the centre of its pixel. */
static float from_centre(float x)
{
	return x - floorf(x) - 0.5f;
}

/* Do an offset and a direction point the same way? 0 counts as positive along x and as negative along y. */
static int same_way(float place, float d, int is_y)
{
	return is_y ? (place <= 0) == (d <= 0) : (place >= 0) == (d >= 0);
}

/*
 * Does a line in direction (d_major, d_minor) draw the pixel of its end, which lies at (major, minor) in that pixel?
 * The diamond-exit rule (sec. 3.4.1: a line draws a pixel if it leaves its diamond) as implemented by llvmpipe. In
 * border cases llvmpipe tests where the line passes the pixel's middle, with the slope inverted, and includes the low
 * border for the second ends of steep lines. edge: the minor coordinate relative to the pixel's border.
 */
static int draws_end(float major, float minor, float edge, float d_major, float d_minor, int first, int steep)
{
	float crossing;

	if (fabsf(major) + fabsf(minor) < 0.5f)
		return first;
	if (same_way(major, d_major, steep) == first)
		return 0;
	if (same_way(minor, d_minor, !steep) != first)
		return 1;
	crossing = edge + major * (d_minor / d_major);
	return crossing < 1 && (crossing > 0 || (crossing == 0 && steep && !first));
}

/* How far to move an end along the major axis: the quad must cover the pixel's centre exactly if the line draws the
 * end's pixel. */
static float end_shift(const struct expand_input *in, float x, float y, float d_major, float d_minor, int first,
                       int steep)
{
	float at[2] = { from_centre(x), from_centre(y) }, major = at[steep], minor = at[!steep];
	float edge = steep ? x - floorf(x) : y - floorf(y);
	/* In Mesa 22.3, a second end right beside a centre covers it in any direction. */
	int passes = steep ? (major >= 0) == (d_major > 0) : (major > 0) == (d_major > 0);
	int covers = first ? !passes : passes || (major == 0 && !(in->mesa & SCENE_MESA_LINE_ENDS));

	if (!first && minor == -0.5f && d_minor > 0)
		minor = 0.5f;
	if (covers == draws_end(major, minor, edge, d_major, d_minor, first, steep))
		return 0;
	return -major - (d_major > 0 ? 0.5f : -0.5f);
}

#define EVERYWHERE 1e6f /* pixels: beyond all windows */

/* Add a corner for an end, with the end itself and the part of the line that is drawn: see GEOMETRY_LINE. */
static void add_line_corner(const struct expand_input *in, struct expanded *out, const struct expand_end *e, int second,
                            int32_t x, int32_t y, const float drawn[3])
{
	struct shaded_vertex *vertex = &out->vertices[out->n_vertices];

	expand_add_corner(in, out, e, x, y);
	memcpy(vertex->color[1], (float[4]){ e->x, e->y, e->z, (float)second }, sizeof(vertex->color[1]));
	memcpy(vertex->secondary[1], drawn, 3 * sizeof(*drawn));
}

/* Add the projected line a -> b as a quad. */
static void add_line(const struct expand_input *in, struct expanded *out, const struct expand_end *a,
                     const struct expand_end *b, uint32_t draw)
{
	float dx = b->x - a->x, dy = b->y - a->y, width = fmaxf(in->material->line_width, 1);
	int steep = !(fabsf(dx) >= fabsf(dy));
	float d_major = steep ? dy : dx, d_minor = steep ? dx : dy;
	const struct expand_end *ends[2] = { a, b };
	int32_t half = expand_round(in, width) * 128, x[2], y[2];

	if (d_major == 0)
		return;
	for (int i = 0; i < 2; i++) {
		float along = end_shift(in, ends[i]->x, ends[i]->y, d_major, d_minor, i == 0, steep),
		      across = along * (d_minor / d_major);

		x[i] = expand_snap(in, ends[i]->x + (steep ? across : along));
		y[i] = expand_snap(in, ends[i]->y + (steep ? along : across));
	}
	if ((steep ? y[1] > y[0] : x[1] > x[0]) != (d_major > 0))
		return; /* its ends have passed each other: nothing is left inside llvmpipe's edge planes */
	for (int k = 0; k < 4; k++) {
		int i = k == 1 || k == 2;
		int32_t side = k < 2 ? -half : half;

		add_line_corner(in, out, ends[i], i, x[i] + (steep ? side : 0), y[i] + (steep ? 0 : side),
		                (float[3]){ -EVERYWHERE, -EVERYWHERE, EVERYWHERE });
	}
	expand_add_triangles(in, out, draw);
}

/* As expand_snap, but relative to pixel corners, for multisampling. */
static int32_t snap_sampled(const struct expand_input *in, float pixels)
{
	return expand_round(in, pixels * 256);
}

/* Range of pixels along one axis that llvmpipe (22.3.6) draws for a line's rectangle. It rounds both ends up. */
struct extent {
	int32_t first, end;
};

/* edge: 1 if a position on a border between pixels counts as beyond it */
static struct extent extent_of(const int32_t *v, int edge)
{
	int32_t least = v[0], most = v[0];

	for (int k = 1; k < 4; k++) {
		least = v[k] < least ? v[k] : least;
		most = v[k] > most ? v[k] : most;
	}
	return (struct extent){ (least + 255 + edge) >> 8, (most + 255 + edge) >> 8 };
}

/* First pixel drawn. llvmpipe fills rectangles tile by tile, starting at the tile of their first pixel. */
static float first_drawn(struct extent e)
{
	return e.first % 64 == 0 ? (float)e.first : -EVERYWHERE;
}

/* Add the line a -> b for multisampling: a rectangle of the line's width along it (sec. 3.4.4). */
static void add_line_rectangle(const struct expand_input *in, struct expanded *out, const struct expand_end *a,
                               const struct expand_end *b, uint32_t draw)
{
	float dx = a->x - b->x, dy = a->y - b->y, area = dx * dx + dy * dy;
	float scale = fmaxf(in->material->line_width, 1) * 0.5f / sqrtf(area),
	      drawn[3] = { 0, -EVERYWHERE, EVERYWHERE };
	int32_t side_x = snap_sampled(in, -dy * scale), side_y = snap_sampled(in, dx * scale), x[4], y[4], row[4];
	struct extent columns, rows;

	if (!(area > 0))
		return;
	for (int k = 0; k < 4; k++) {
		const struct expand_end *e = k == 1 || k == 2 ? b : a;
		int32_t side = k < 2 ? -1 : 1;

		x[k] = snap_sampled(in, e->x) + side * side_x;
		y[k] = snap_sampled(in, e->y) + side * side_y;
		row[k] = in->from_below ? (int32_t)in->height * 256 - y[k] : y[k];
	}
	columns = extent_of(x, 0);
	rows = extent_of(row, !in->from_below);
	if (columns.end <= columns.first || rows.end <= rows.first)
		return;
	drawn[0] = first_drawn(columns);
	if (in->from_below)
		drawn[2] = (float)in->height - 1 - first_drawn(rows);
	else
		drawn[1] = first_drawn(rows);
	for (int k = 0; k < 4; k++)
		add_line_corner(in, out, k == 1 || k == 2 ? b : a, k == 1 || k == 2, x[k], y[k], drawn);
	expand_add_triangles(in, out, draw);
}

/*
 * Compute half the length of a smooth line's quad, for its coverage, and the line's direction. As in Mesa 22.3, do not
 * divide by the length: lines drawn back over themselves show the last bits. A line of length 0 is horizontal; Mesa
 * 25.0 omits it.
 */
static float turn_smooth_line(const struct expand_input *in, float *dx, float *dy)
{
	float length = sqrtf(*dx * *dx + *dy * *dy), angle = atan2f(*dy, *dx);

	if (in->mesa & SCENE_MESA_SMOOTH_LINES) {
		*dx /= length;
		*dy /= length;
		return length > 0 ? 0.5f * length + 0.5f : -1;
	}
	*dx = cosf(angle);
	*dy = sinf(angle);
	return length < 1 ? length : 0.5f * length + 0.5f;
}

/* Add a smooth line as Mesa's draw module does: half a pixel longer at each end, half a pixel wider on each side. */
static void add_smooth_line(const struct expand_input *in, struct expanded *out, const struct expand_end *a,
                            const struct expand_end *b, uint32_t draw)
{
	float dx = b->x - a->x, dy = b->y - a->y, half_length = turn_smooth_line(in, &dx, &dy);
	float half = in->material->line_width <= 1 ? 1 : 0.5f * in->material->line_width + 0.5f;

	if (!(half_length >= 0))
		return;
	/* Cut the quad along the same diagonal as Mesa: if w varies along the line, the two diagonals give different
	 * results. */
	for (int k = 0; k < 4; k++) {
		const struct expand_end *e = k >= 2 ? b : a;
		float along = e == b ? 0.5f : -0.5f, across = k == 1 || k == 2 ? half : -half;

		expand_add_smooth_corner(in, out, e, e->x + (along * dx - across * dy),
		                         e->y + (along * dy + across * dx),
		                         (float[4]){ -across, half, e == b ? half_length : -half_length, half_length });
	}
	expand_add_triangles(in, out, draw);
}

static int add_dash(const struct expand_input *in, struct expanded *out, const struct expand_end *a,
                    const struct expand_end *b, uint32_t draw)
{
	if (expand_reserve_quad(in, out))
		return ERR_SYSTEM;
	if (in->material->line_smooth)
		add_smooth_line(in, out, a, b, draw);
	else if (in->material->multisample)
		add_line_rectangle(in, out, a, b, draw);
	else
		add_line(in, out, a, b, draw);
	return 0;
}

int expand_edge(const struct expand_input *in, struct expanded *out, struct expand_end *a, struct expand_end *b,
                float offset, uint32_t draw)
{
	const uint32_t pattern = in->material->line_stipple & 0xffff, factor = in->material->line_stipple >> 16;
	float length;
	uint32_t start = 0, n;
	int err = 0;

	expand_project(in, a);
	expand_project(in, b);
	a->z = fminf(fmaxf(a->z + offset, 0), 1);
	b->z = fminf(fmaxf(b->z + offset, 0), 1);
	if (!factor)
		return add_dash(in, out, a, b, draw);
	length = in->material->multisample || in->material->line_smooth ?
	                 sqrtf((b->x - a->x) * (b->x - a->x) + (b->y - a->y) * (b->y - a->y)) :
	                 fmaxf(fabsf(b->x - a->x), fabsf(b->y - a->y));
	n = isfinite(length) ? (uint32_t)ceilf(length) : 0;
	for (uint32_t i = 0; i <= n && !err; i++) {
		int on = i < n && pattern >> (((uint32_t)*in->dashed + i) / factor & 15) & 1;

		if (!on && i > start) {
			struct expand_end from = expand_line_point(a, b, (float)start / length);
			struct expand_end to = expand_line_point(a, b, fminf((float)i / length, 1));

			err = add_dash(in, out, &from, &to, draw);
		}
		start = on ? start : i + 1;
	}
	*in->dashed += (float)n;
	return err;
}
