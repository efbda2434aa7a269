#include "tracer/frame/expand.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "gl_tokens.h"

/* A vertex on its way: attributes, and where it is in the window, y down as llvmpipe counts. */
struct end {
	struct shaded_vertex v;
	float texcoord[SCENE_MAX_UNITS][4];
	float x, y, z, w_inv;
	int cut; /* an end that clipping made */
};

static int grow(const struct expand_input *in, struct expanded *e)
{
	uint32_t room = e->room ? 2 * e->room : 64, units = in->material->unit_count;
	struct shaded_vertex *vertices = realloc(e->vertices, room * 4 * sizeof(*vertices));
	struct window_vertex *windows;
	float (*texcoords)[4], (*position)[4];
	uint32_t *index, *primitive_draw;

	if (!vertices)
		return ERR_SYSTEM;
	e->vertices = vertices;
	if (!(windows = realloc(e->windows, room * 4 * sizeof(*windows))))
		return ERR_SYSTEM;
	e->windows = windows;
	if (!(texcoords = realloc(e->texcoords, ((size_t)room * 4 * units + 1) * sizeof(*texcoords))))
		return ERR_SYSTEM;
	e->texcoords = texcoords;
	if (!(position = realloc(e->position, room * 4 * sizeof(*position))))
		return ERR_SYSTEM;
	e->position = position;
	if (!(index = realloc(e->index, room * 6 * sizeof(*index))))
		return ERR_SYSTEM;
	e->index = index;
	if (!(primitive_draw = realloc(e->primitive_draw, room * 2 * sizeof(*primitive_draw))))
		return ERR_SYSTEM;
	e->primitive_draw = primitive_draw;
	e->room = room;
	return 0;
}

/* --- Vertices ------------------------------------------------------------------------------------------------------ */

static struct end load(const struct expand_input *in, uint32_t v, int side)
{
	struct end e = { .v = in->vertices[v] };
	uint32_t units = in->material->unit_count;

	memcpy(e.v.color[0], in->vertices[v].color[side], sizeof(e.v.color[0]));
	memcpy(e.v.color[1], in->vertices[v].color[side], sizeof(e.v.color[1]));
	memcpy(e.v.secondary[0], in->vertices[v].secondary[side], sizeof(e.v.secondary[0]));
	memcpy(e.v.secondary[1], in->vertices[v].secondary[side], sizeof(e.v.secondary[1]));
	if (units)
		memcpy(e.texcoord, in->texcoords + (size_t)v * units, units * sizeof(e.texcoord[0]));
	return e;
}

/* Flat shading: the colour of the primitive's last vertex. */
static void take_color(struct end *e, const struct end *from)
{
	memcpy(e->v.color, from->v.color, sizeof(e->v.color));
	memcpy(e->v.secondary, from->v.secondary, sizeof(e->v.secondary));
}

static void mix_floats(const float *a, const float *b, float wa, float wb, float *out, size_t n)
{
	for (size_t i = 0; i < n; i++)
		out[i] = a[i] * wa + b[i] * wb;
}

/* Attributes wa a + wb b; the place in the window stays to be found. */
static struct end mix_ends(const struct end *a, const struct end *b, float wa, float wb)
{
	struct end e = *a;

	mix_floats(a->v.clip, b->v.clip, wa, wb, e.v.clip, 4);
	mix_floats(a->v.eye, b->v.eye, wa, wb, e.v.eye, 4);
	mix_floats(&a->v.color[0][0], &b->v.color[0][0], wa, wb, &e.v.color[0][0], 8);
	mix_floats(&a->v.secondary[0][0], &b->v.secondary[0][0], wa, wb, &e.v.secondary[0][0], 8);
	mix_floats(a->v.normal, b->v.normal, wa, wb, e.v.normal, 3);
	mix_floats(&a->v.fog_coord, &b->v.fog_coord, wa, wb, &e.v.fog_coord, 1);
	mix_floats(&a->texcoord[0][0], &b->texcoord[0][0], wa, wb, &e.texcoord[0][0], SCENE_MAX_UNITS * 4);
	return e;
}

/* As the vertex stage does, but not snapped. Mesa's clipper projects the ends that it makes without fused operations. */
static float scale_and_move(float scale, float x, float move, int fused)
{
	return fused ? fmaf(scale, x, move) : scale * x + move;
}

static void project(const struct expand_input *in, struct end *e)
{
	const float *v = in->view->viewport, *c = e->v.clip, *range = in->view->depth_range;
	int fused = !e->cut;

	e->w_inv = 1 / c[3];
	e->x = scale_and_move(v[2] * 0.5f, c[0] * e->w_inv, v[0] + v[2] * 0.5f, fused);
	e->y = scale_and_move(-v[3] * 0.5f, c[1] * e->w_inv, (float)in->height - (v[1] + v[3] * 0.5f), fused);
	e->z = scale_and_move((range[1] - range[0]) * 0.5f, c[2] * e->w_inv, (range[1] + range[0]) * 0.5f, fused);
}

/* Signed distances to the planes of the view volume: near, far, and four around. */
static float clip_distance(const float *c, int plane)
{
	float side = plane & 1 ? -1 : 1;

	return c[3] + side * c[plane < 2 ? 2 : (plane - 2) / 2];
}

static void move_floats(float *from, const float *to, float t, size_t n)
{
	for (size_t i = 0; i < n; i++)
		from[i] += t * (to[i] - from[i]);
}

/* An end moved towards the other one, in Mesa's order of operations. */
static void move_end(struct end *e, const struct end *to, float t)
{
	move_floats(e->v.clip, to->v.clip, t, 4);
	move_floats(e->v.eye, to->v.eye, t, 4);
	move_floats(&e->v.color[0][0], &to->v.color[0][0], t, 8);
	move_floats(&e->v.secondary[0][0], &to->v.secondary[0][0], t, 8);
	move_floats(e->v.normal, to->v.normal, t, 3);
	move_floats(&e->v.fog_coord, &to->v.fog_coord, t, 1);
	move_floats(&e->texcoord[0][0], &to->texcoord[0][0], t, SCENE_MAX_UNITS * 4);
	e->cut = 1;
}

/* The planes that cut: the volume's, and after them those of the program that are enabled (sec. 2.12), which cut in eye space. */
enum { N_VOLUME_PLANES = 6, N_PLANES = N_VOLUME_PLANES + SCENE_MAX_CLIP_PLANES };

static float plane_distance(const struct expand_input *in, const struct end *e, int plane)
{
	const float *p, *eye = e->v.eye;

	if (plane < N_VOLUME_PLANES)
		return clip_distance(e->v.clip, plane);
	plane -= N_VOLUME_PLANES;
	p = in->material->clip_plane_eye[plane];
	return in->material->clip_plane_mask >> plane & 1 ? p[0] * eye[0] + p[1] * eye[1] + p[2] * eye[2] + p[3] * eye[3] : 0;
}

/* Cut a line to what can be seen. @return 0 where nothing is left */
static int clip_line(const struct expand_input *in, struct end *a, struct end *b)
{
	float t_a = 0, t_b = 0; /* shares cut off at either end */
	struct end from = *a;

	for (int plane = 0; plane < N_PLANES; plane++) {
		float da = plane_distance(in, a, plane), db = plane_distance(in, b, plane);

		if (da < 0 && db < 0)
			return 0;
		if (da < 0)
			t_a = fmaxf(t_a, da / (da - db));
		else if (db < 0)
			t_b = fmaxf(t_b, db / (db - da));
	}
	if (t_a + t_b >= 1)
		return 0;
	if (t_a > 0)
		move_end(a, b, t_a);
	if (t_b > 0)
		move_end(b, &from, t_b);
	return a->v.clip[3] > 0 && b->v.clip[3] > 0;
}

/* --- Quads --------------------------------------------------------------------------------------------------------- */

/* 1/256 pixel from the pixel corner, halves as llvmpipe rounds those of lines and points: a centre is 0 for it. */
static int32_t snap(float pixels)
{
	float x = (pixels - 0.5f) * 256;

	return (int32_t)(x >= 0 ? x + 0.5f : x - 0.5f) + 128;
}

/* Add a corner of a quad. x, y: in 1/256 pixel, y down. */
static void add_corner(const struct expand_input *in, struct expanded *out, const struct end *e, int32_t x, int32_t y)
{
	uint32_t at = out->n_vertices++, units = in->material->unit_count;
	int32_t up = (int32_t)in->height * 256 - y;
	const float *v = in->view->viewport, *range = in->view->depth_range;
	float w = 1 / e->w_inv, px = (float)x / 256, py = (float)up / 256;
	float half_range = (range[1] - range[0]) * 0.5f;
	struct shaded_vertex *vertex = &out->vertices[at];

	*vertex = e->v;
	vertex->clip[0] = (2 * (px - v[0]) / v[2] - 1) * w;
	vertex->clip[1] = (2 * (py - v[1]) / v[3] - 1) * w;
	vertex->clip[2] = half_range != 0 ? (e->z - range[0] - half_range) / half_range * w : 0;
	vertex->clip[3] = w;
	vertex->lit[0] = vertex->lit[1] = 0;
	out->windows[at] = (struct window_vertex){ x, up, e->z, e->w_inv };
	memcpy(out->position[at], (float[4]){ px, py, 0, 1 }, sizeof(out->position[at]));
	if (units)
		memcpy(out->texcoords + (size_t)at * units, e->texcoord, units * sizeof(e->texcoord[0]));
	out->n_texcoords += units;
}

/*
 * Two triangles over the last four corners, front side up. Their corners are in the order of Mesa's draw module, which decides
 * the last bits of what is interpolated: turning one exchanges its first two, as llvmpipe does.
 */
static void add_triangles(const struct expand_input *in, struct expanded *out, uint32_t draw)
{
	uint32_t first = out->n_vertices - 4, *index = out->index + 3 * (size_t)out->n_primitives;
	const struct window_vertex *w = out->windows + first;
	int64_t area = ((int64_t)w[1].x - w[0].x) * ((int64_t)w[2].y - w[0].y) -
	               ((int64_t)w[2].x - w[0].x) * ((int64_t)w[1].y - w[0].y);
	uint32_t turn = (area > 0) != (in->material->front_face == GL_CCW);
	const uint32_t corners[2][3] = { { 2, 0, 1 }, { 3, 0, 2 } };

	for (unsigned i = 0; i < 2; i++) {
		*index++ = first + corners[i][turn];
		*index++ = first + corners[i][!turn];
		*index++ = first + corners[i][2];
	}
	out->primitive_draw[out->n_primitives] = out->primitive_draw[out->n_primitives + 1] = draw;
	out->n_primitives += 2;
}

/* The point at share s of a projected line: attributes over w are linear in the window. */
static struct end line_point(const struct end *a, const struct end *b, float s)
{
	float w_inv = a->w_inv + (b->w_inv - a->w_inv) * s, w;
	struct end e;

	if (!(w_inv > 0)) { /* beyond an end, and beyond the eye */
		s = s < 0.5f ? 0 : 1;
		w_inv = s > 0 ? b->w_inv : a->w_inv;
	}
	w = 1 / w_inv;
	e = mix_ends(a, b, (1 - s) * a->w_inv * w, s * b->w_inv * w);
	e.x = a->x + (b->x - a->x) * s;
	e.y = a->y + (b->y - a->y) * s;
	e.z = a->z + (b->z - a->z) * s;
	e.w_inv = w_inv;
	return e;
}

/* The place of a coordinate in its pixel, from the centre. */
static float from_centre(float x)
{
	return x - floorf(x) - 0.5f;
}

/* Do a place and a direction point the same way? 0 counts as positive along x and as negative along y. */
static int same_way(float place, float d, int is_y)
{
	return is_y ? (place <= 0) == (d <= 0) : (place >= 0) == (d >= 0);
}

/*
 * Does a line that runs by d_major and d_minor draw the pixel of an end that lies at (major, minor) in it?
 * The diamond-exit rule (sec. 3.4.1: the line draws a pixel whose diamond it leaves) as llvmpipe has it. In doubt it looks
 * where the line passes the pixel's middle, with the slope turned over, and counts the low border in for steep lines' second ends.
 * edge: the minor coordinate from the pixel's border.
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

/* How far an end moves along the major axis, so that the quad covers the pixel's centre if the end's pixel is drawn. */
static float end_shift(float x, float y, float d_major, float d_minor, int first, int steep)
{
	float at[2] = { from_centre(x), from_centre(y) }, major = at[steep], minor = at[!steep];
	float edge = steep ? x - floorf(x) : y - floorf(y);
	int covers = first ? !same_way(major, d_major, !steep) : same_way(major, d_major, steep) || major == 0;

	if (!first && minor == -0.5f && d_minor > 0)
		minor = 0.5f;
	if (covers == draws_end(major, minor, edge, d_major, d_minor, first, steep))
		return 0;
	return -major - (d_major > 0 ? 0.5f : -0.5f);
}

#define EVERYWHERE 1e6f /* pixels: beyond all windows */

/* Add an end's corner, with the end as it is and what of the line is drawn: see GEOMETRY_LINE. */
static void add_line_corner(const struct expand_input *in, struct expanded *out, const struct end *e, int second, int32_t x,
                            int32_t y, const float drawn[3])
{
	struct shaded_vertex *vertex = &out->vertices[out->n_vertices];

	add_corner(in, out, e, x, y);
	memcpy(vertex->color[1], (float[4]){ e->x, e->y, e->z, (float)second }, sizeof(vertex->color[1]));
	memcpy(vertex->secondary[1], drawn, 3 * sizeof(*drawn));
}

/* The line a -> b, projected, as a quad. */
static void add_line(const struct expand_input *in, struct expanded *out, const struct end *a, const struct end *b,
                     uint32_t draw)
{
	float dx = b->x - a->x, dy = b->y - a->y, width = fmaxf(in->material->line_width, 1);
	int steep = !(fabsf(dx) >= fabsf(dy));
	float d_major = steep ? dy : dx, d_minor = steep ? dx : dy;
	const struct end *ends[2] = { a, b };
	int32_t half = (int32_t)(width + 0.5f) * 128, x[2], y[2];

	if (d_major == 0)
		return;
	for (int i = 0; i < 2; i++) {
		float along = end_shift(ends[i]->x, ends[i]->y, d_major, d_minor, i == 0, steep), across = along * (d_minor / d_major);

		x[i] = snap(ends[i]->x + (steep ? across : along));
		y[i] = snap(ends[i]->y + (steep ? along : across));
	}
	for (int k = 0; k < 4; k++) {
		int i = k == 1 || k == 2;
		int32_t side = k < 2 ? -half : half;

		add_line_corner(in, out, ends[i], i, x[i] + (steep ? side : 0), y[i] + (steep ? 0 : side),
		                (float[3]){ -EVERYWHERE, -EVERYWHERE, EVERYWHERE });
	}
	add_triangles(in, out, draw);
}

/* As snap, where pixels have samples: counted from their corner. */
static int32_t snap_sampled(float pixels)
{
	float x = pixels * 256;

	return (int32_t)(x >= 0 ? x + 0.5f : x - 0.5f);
}

/* Pixels of one axis that llvmpipe (22.3.6) draws of a rectangle along a line; it rounds both sides of their range up. */
struct extent {
	int32_t first, end;
};

/* edge: 1 where a place on a border between pixels counts as beyond it */
static struct extent extent_of(const int32_t *v, int edge)
{
	int32_t least = v[0], most = v[0];

	for (int k = 1; k < 4; k++) {
		least = v[k] < least ? v[k] : least;
		most = v[k] > most ? v[k] : most;
	}
	return (struct extent){ (least + 255 + edge) >> 8, (most + 255 + edge) >> 8 };
}

/* The first pixel that is drawn: rectangles are filled tile by tile, from the tile of their extent's first pixel on. */
static float first_drawn(struct extent e)
{
	return e.first % 64 == 0 ? (float)e.first : -EVERYWHERE;
}

/* The line a -> b under multisampling: a rectangle of the line's width along it (sec. 3.4.4). */
static void add_line_rectangle(const struct expand_input *in, struct expanded *out, const struct end *a, const struct end *b,
                               uint32_t draw)
{
	float dx = a->x - b->x, dy = a->y - b->y, area = dx * dx + dy * dy;
	float scale = fmaxf(in->material->line_width, 1) * 0.5f / sqrtf(area), drawn[3] = { 0, -EVERYWHERE, EVERYWHERE };
	int32_t side_x = snap_sampled(-dy * scale), side_y = snap_sampled(dx * scale), x[4], y[4], row[4];
	struct extent columns, rows;

	if (!(area > 0))
		return;
	for (int k = 0; k < 4; k++) {
		const struct end *e = k == 1 || k == 2 ? b : a;
		int32_t side = k < 2 ? -1 : 1;

		x[k] = snap_sampled(e->x) + side * side_x;
		y[k] = snap_sampled(e->y) + side * side_y;
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
	add_triangles(in, out, draw);
}

/* A corner of a smooth quad: its place is not snapped for attributes. coverage: see GEOMETRY_SMOOTH_LINE */
static void add_smooth_corner(const struct expand_input *in, struct expanded *out, const struct end *e, float x, float y,
                              const float coverage[4])
{
	struct shaded_vertex *vertex = &out->vertices[out->n_vertices];
	const float *v = in->view->viewport;
	float w = 1 / e->w_inv;

	add_corner(in, out, e, snap(x), snap(y));
	vertex->clip[0] = (2 * (x - v[0]) / v[2] - 1) * w;
	vertex->clip[1] = (2 * ((float)in->height - y - v[1]) / v[3] - 1) * w;
	vertex->size[0] = x;
	vertex->size[1] = y;
	memcpy(vertex->color[1], coverage, sizeof(vertex->color[1]));
}

/* A smooth line as Mesa's draw module (22.3) makes it: longer by half a pixel at each end, wider by half a pixel a side. */
static void add_smooth_line(const struct expand_input *in, struct expanded *out, const struct end *a, const struct end *b,
                            uint32_t draw)
{
	float dx = b->x - a->x, dy = b->y - a->y, length = sqrtf(dx * dx + dy * dy);
	float half_length = length < 1 ? length : 0.5f * length + 0.5f;
	float half = in->material->line_width <= 1 ? 1 : 0.5f * in->material->line_width + 0.5f, angle = atan2f(dy, dx);

	if (!(length >= 0))
		return;
	/* Not divided by the length: lines drawn back over themselves show the last bits, and one without a length lies flat. */
	dx = cosf(angle);
	dy = sinf(angle);
	/* From the corner on whose diagonal Mesa cuts the quad: where w differs along the line the two parts bend apart. */
	for (int k = 0; k < 4; k++) {
		const struct end *e = k >= 2 ? b : a;
		float along = e == b ? 0.5f : -0.5f, across = k == 1 || k == 2 ? half : -half;

		add_smooth_corner(in, out, e, e->x + (along * dx - across * dy), e->y + (along * dy + across * dx),
		                  (float[4]){ -across, half, e == b ? half_length : -half_length, half_length });
	}
	add_triangles(in, out, draw);
}

static void add_smooth_point(const struct expand_input *in, struct expanded *out, const struct end *e, uint32_t draw)
{
	const float *fade = in->material->point_attenuation, size = e->v.size[0];
	int attenuated = fade[0] != 1 || fade[1] != 0 || fade[2] != 0;
	float radius = !attenuated && size <= 2 ? 1 : 0.5f * size;

	for (int k = 0; k < 4; k++) {
		float x = k == 1 || k == 2 ? 1 : -1, y = k >= 2 ? 1 : -1;

		add_smooth_corner(in, out, e, e->x + x * radius, e->y + y * radius, (float[4]){ x, y, 0, 0 });
	}
	add_triangles(in, out, draw);
}

static void add_point(const struct expand_input *in, struct expanded *out, const struct end *e, uint32_t draw)
{
	const struct scene_material *m = in->material;
	int32_t width = (int32_t)fmaxf(e->v.size[0] * 256 + 0.5f, 256), x = snap(e->x) - width / 2, y = snap(e->y) - width / 2;
	/* Under multisampling llvmpipe takes a sprite's middle half a pixel off where it is. */
	float off = m->multisample ? 128 / (float)width : 0;

	/* Other than sprites, and under multisampling, they are whole pixels (sec. 3.3.1), of widths and places rounded as llvmpipe does it. */
	if (!m->point_sprite && !m->point_smooth && !m->multisample) {
		int32_t pixels = (width + 127) >> 8, middle = pixels & 1 ? 0 : 128;

		x = (((snap(e->x) + middle) >> 8) - pixels / 2) * 256;
		y = (((snap(e->y) - 1 + middle) >> 8) - pixels / 2) * 256; /* what is on an edge belongs above it */
		width = pixels * 256;
	}
	for (int k = 0; k < 4; k++) {
		int right = k == 1 || k == 2, low = k >= 2;
		struct end corner = *e;

		for (uint32_t u = 0; u < m->unit_count && m->point_sprite; u++)
			if (in->units[u].coord_replace)
				memcpy(corner.texcoord[u], (float[4]){ (float)right + off, m->point_sprite == 2 ? (float)!low - off : (float)low + off, 0, 1 },
				       sizeof(corner.texcoord[u]));
		add_corner(in, out, &corner, x + (right ? width : 0), y + (low ? width : 0));
	}
	add_triangles(in, out, draw);
}

#define FARTHEST 32768.0f /* pixels from a window's corner: twice what any window has */

/*
 * Rows or columns of a pixel rectangle that come near the window, and where they begin and end along its axis: beyond, places
 * have no number in 1/256 pixel. What is as wide as that all by itself ends there.
 */
static void keep_near(float corner, float zoom, uint32_t n, float kept[2], float place[2])
{
	const float low = (-FARTHEST - corner) / zoom, high = (FARTHEST - corner) / zoom;

	kept[0] = fminf(fmaxf(floorf(fminf(low, high)), 0), (float)n);
	kept[1] = fminf(fmaxf(ceilf(fmaxf(low, high)), 0), (float)n);
	for (int i = 0; i < 2; i++)
		place[i] = fminf(fmaxf(corner + kept[i] * zoom, -2 * FARTHEST), 2 * FARTHEST);
}

/* A bitmap or pixel rectangle whose first corner is a vertex of the mesh, in window coordinates. */
static int rectangle(const struct expand_input *in, struct expanded *out, uint32_t i, uint32_t draw)
{
	const struct scene_rectangle *r = &in->rectangles[i];
	const float *corner = in->mesh->position + 4 * (size_t)i;
	struct end e = load(in, i, 0);
	float column[2], row[2], x[2], y[2];

	if (out->n_vertices / 4 == out->room && grow(in, out))
		return ERR_SYSTEM;
	e.w_inv = 1;
	e.z = fminf(fmaxf(corner[2], 0), 1);
	keep_near(corner[0], r->zoom[0], r->width, column, x);
	keep_near(corner[1], r->zoom[1], r->height, row, y);
	for (int k = 0; k < 4; k++) {
		int right = k == 1 || k == 2, high = k >= 2;

		add_smooth_corner(in, out, &e, x[right], (float)in->height - y[high],
		                  (float[4]){ column[right], row[high], (float)r->texture, (float)r->kind });
	}
	add_triangles(in, out, draw);
	return 0;
}

/* --- Primitives ---------------------------------------------------------------------------------------------------- */

/* State of the line stipple (sec. 3.4.2): pixels so far along a strip. */
struct stipple {
	uint32_t pattern, factor, counter;
};

static int add_dash(const struct expand_input *in, struct expanded *out, const struct end *a, const struct end *b,
                    uint32_t draw)
{
	if (out->n_vertices / 4 == out->room && grow(in, out))
		return ERR_SYSTEM;
	if (in->material->line_smooth)
		add_smooth_line(in, out, a, b, draw);
	else if (in->material->multisample)
		add_line_rectangle(in, out, a, b, draw);
	else
		add_line(in, out, a, b, draw);
	return 0;
}

/* A line, clipped, projected and cut into the dashes that its stipple leaves. */
static int line(const struct expand_input *in, struct expanded *out, struct end a, struct end b, float offset,
                uint32_t draw, struct stipple *stipple)
{
	float length;
	uint32_t start = 0, n;
	int err = 0;

	if (!clip_line(in, &a, &b))
		return 0;
	project(in, &a);
	project(in, &b);
	a.z = fminf(fmaxf(a.z + offset, 0), 1);
	b.z = fminf(fmaxf(b.z + offset, 0), 1);
	if (stipple->pattern == 0xffff)
		return add_dash(in, out, &a, &b, draw);
	length = in->material->multisample || in->material->line_smooth ?
	                 sqrtf((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y)) : fmaxf(fabsf(b.x - a.x), fabsf(b.y - a.y));
	n = (uint32_t)ceilf(length);
	for (uint32_t i = 0; i <= n && !err; i++) {
		int on = i < n && stipple->pattern >> (stipple->counter / stipple->factor & 15) & 1;

		if (!on && i > start) {
			struct end from = line_point(&a, &b, (float)start / length);
			struct end to = line_point(&a, &b, fminf((float)i / length, 1));

			err = add_dash(in, out, &from, &to, draw);
		}
		start = on ? start : i + 1;
		stipple->counter += i < n;
	}
	return err;
}

static int point(const struct expand_input *in, struct expanded *out, struct end e, float offset, uint32_t draw)
{
	for (int plane = 0; plane < N_PLANES; plane++) {
		if (plane_distance(in, &e, plane) < 0) /* their centre must lie in the view (sec. 2.12) */
			return 0;
	}
	if (!(e.v.clip[3] > 0))
		return 0;
	project(in, &e);
	e.z = fminf(fmaxf(e.z + offset, 0), 1);
	if (out->n_vertices / 4 == out->room && grow(in, out))
		return ERR_SYSTEM;
	if (in->material->point_smooth && !in->material->point_sprite)
		add_smooth_point(in, out, &e, draw);
	else
		add_point(in, out, &e, draw);
	return 0;
}

/* Polygon offset of a triangle that is drawn as lines or points (sec. 3.5.5). */
static float polygon_offset(const struct expand_input *in, const struct end *e)
{
	const struct scene_material *m = in->material;
	uint32_t bit = in->shape == PREPARED_LINES ? 2 : 1, bits = in->depth_bits > 24 ? 24 : in->depth_bits;
	struct end p[3] = { e[0], e[1], e[2] };
	float x1, y1, z1, x2, y2, z2, area, slope = 0;

	if (!(m->polygon_offset & bit))
		return 0;
	for (int i = 0; i < 3; i++)
		project(in, &p[i]);
	x1 = p[1].x - p[0].x;
	y1 = p[1].y - p[0].y;
	z1 = p[1].z - p[0].z;
	x2 = p[2].x - p[0].x;
	y2 = p[2].y - p[0].y;
	z2 = p[2].z - p[0].z;
	area = x1 * y2 - x2 * y1;
	if (area != 0)
		slope = fmaxf(fabsf((z1 * y2 - z2 * y1) / area), fabsf((z2 * x1 - z1 * x2) / area));
	return slope * m->polygon_offset_factor + m->polygon_offset_units / (float)((1u << (bits ? bits : 24)) - 1);
}

/* 1 where a triangle faces its viewer with its front (sign of its area in clip space). */
static int is_front(const struct expand_input *in, const uint32_t *index)
{
	const float *a = in->vertices[index[0]].clip, *b = in->vertices[index[1]].clip, *c = in->vertices[index[2]].clip;
	float det = a[3] * (b[0] * c[1] - c[0] * b[1]) + b[3] * (c[0] * a[1] - a[0] * c[1]) +
	            c[3] * (a[0] * b[1] - b[0] * a[1]);

	return (det > 0) == (in->material->front_face == GL_CCW);
}

static int expand_polygon(const struct expand_input *in, struct expanded *out, uint32_t primitive, uint32_t draw,
                          struct stipple *stipple)
{
	const uint32_t *index = in->mesh->index + 3 * (size_t)primitive;
	uint32_t flags = in->mesh->edge_flags ? in->mesh->edge_flags[primitive] : 7;
	int front = is_front(in, index), side = in->material->lighting && in->material->two_side && !front, err = 0;
	struct end e[3];
	float offset;

	if (in->cull & (front ? INSTANCE_CULL_FRONT : INSTANCE_CULL_BACK))
		return 0;
	for (int i = 0; i < 3; i++)
		e[i] = load(in, index[i], side);
	if (in->material->shade_model == GL_FLAT)
		for (int i = 0; i < 2; i++)
			take_color(&e[i], &e[2]);
	offset = polygon_offset(in, e);
	for (int i = 0; i < 3 && !err; i++) {
		if (!(flags >> i & 1))
			continue;
		err = in->shape == PREPARED_LINES ? line(in, out, e[i], e[(i + 1) % 3], offset, draw, stipple) :
		                                    point(in, out, e[i], offset, draw);
	}
	return err;
}

static int expand_line(const struct expand_input *in, struct expanded *out, uint32_t primitive, uint32_t draw,
                       struct stipple *stipple)
{
	const uint32_t *index = in->mesh->index + 2 * (size_t)primitive;
	struct end a = load(in, index[0], 0), b = load(in, index[1], 0);

	/* A line that starts where the last one ended continues a strip. */
	if (primitive == 0 || index[0] != index[-1])
		stipple->counter = 0;
	if (in->material->shade_model == GL_FLAT)
		take_color(in->material->first_provokes ? &b : &a, in->material->first_provokes ? &a : &b);
	return line(in, out, a, b, 0, draw, stipple);
}

static void make_mesh(struct expanded *e)
{
	XXH128_hash_t hash;

	e->mesh = (struct scene_mesh){ .kind = SCENE_TRIANGLES, .vertex_count = e->n_vertices,
		                       .primitive_count = e->n_primitives, .position = (const float *)e->position,
		                       .index = e->index, .primitive_draw = e->primitive_draw };
	hash = XXH3_128bits(e->position, e->n_vertices * sizeof(*e->position));
	/* not to be taken for a mesh of the scene's that has the same positions, nor for the same quads of another draw */
	hash = XXH3_128bits_withSeed(e->index, e->n_primitives * 3 * sizeof(*e->index), hash.low64 ^ hash.high64 ^ 1);
	hash = XXH3_128bits_withSeed(e->primitive_draw, e->n_primitives * sizeof(*e->primitive_draw),
	                             hash.low64 ^ hash.high64);
	e->mesh.hash[0] = hash.low64;
	e->mesh.hash[1] = hash.high64;
}

int expand_primitives(const struct expand_input *in, struct expanded *out)
{
	struct stipple stipple = { in->material->line_stipple ? in->material->line_stipple & 0xffff : 0xffff,
		                   in->material->line_stipple >> 16, 0 };
	int err = grow(in, out);

	if (stipple.factor == 0)
		stipple.factor = 1;
	for (uint32_t i = 0; i < in->mesh->primitive_count && !err; i++) {
		uint32_t draw = in->mesh->primitive_draw ? in->mesh->primitive_draw[i] : 0;

		if (in->rectangles)
			err = rectangle(in, out, in->mesh->index[i], draw);
		else if (in->mesh->kind == SCENE_TRIANGLES)
			err = expand_polygon(in, out, i, draw, &stipple);
		else if (in->mesh->kind == SCENE_LINES)
			err = expand_line(in, out, i, draw, &stipple);
		else
			err = point(in, out, load(in, in->mesh->index[i], 0), 0, draw);
	}
	if (err) {
		expanded_free(out);
		return err_report(ERR_SYSTEM, NULL, "out of memory for lines and points");
	}
	make_mesh(out);
	return 0;
}

void expanded_free(struct expanded *e)
{
	free(e->vertices);
	free(e->windows);
	free(e->texcoords);
	free(e->position);
	free(e->index);
	free(e->primitive_draw);
	memset(e, 0, sizeof(*e));
}
