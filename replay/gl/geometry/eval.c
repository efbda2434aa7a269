/*
 * Evaluators (GL 2.1 sec. 5.1): Bezier curves and surfaces generate vertices and their attributes. Grids and enables
 * belong to attribute groups (state/attrib.c); the maps do not.
 */
#include "replay/gl/geometry/eval.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/bytes.h"
#include "capture/format/call.h"
#include "replay/gl/geometry/pending.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

#define MAX_ORDER 30
#define POINTS_A_REPEAT 64 /* this many count as one operation of a list (gls_is_beyond_measure) */
#define N_TARGETS 9 /* per dimension, in the order of their tokens */

/*
 * A map: points[u][v][size] for Map2, points[u][size] for Map1. order[0] == 0: not defined, so GL's constant applies.
 */
struct map {
	uint32_t order[2];
	float from[2], to[2];
	float *points;
};

struct gls_maps {
	struct map map[2][N_TARGETS]; /* for Map1, for Map2 */
};

/*
 * Number of components of COLOR_4, INDEX, NORMAL, TEXTURE_COORD_1 .. 4, VERTEX_3, VERTEX_4 (table 5.1), and their
 * initial constants.
 */
static const unsigned sizes[N_TARGETS] = { 4, 1, 3, 1, 2, 3, 4, 3, 4 };
static const float initial[N_TARGETS][4] = { { 1, 1, 1, 1 }, { 1 },          { 0, 0, 1 }, { 0 },         { 0, 0 },
	                                     { 0, 0, 0 },    { 0, 0, 0, 1 }, { 0, 0, 0 }, { 0, 0, 0, 1 } };
enum { COLOR_4, INDEX, NORMAL, TEXTURE_COORD_1, TEXTURE_COORD_4 = TEXTURE_COORD_1 + 3, VERTEX_3, VERTEX_4 };

void gls_maps_free(struct gls_maps *maps)
{
	for (unsigned i = 0; maps && i < 2 * N_TARGETS; i++)
		free(maps->map[i / N_TARGETS][i % N_TARGETS].points);
	free(maps);
}

/* ---- snapshots ---- */

/* Number of floats in a map's points. */
static size_t map_size(const struct map *m, unsigned target)
{
	return (size_t)m->order[0] * m->order[1] * sizes[target];
}

void gls_maps_save(const struct gls_maps *maps, struct bytes *out)
{
	bytes_put_u64(out, maps != NULL);
	for (unsigned i = 0; maps && i < 2 * N_TARGETS; i++) {
		const struct map *m = &maps->map[i / N_TARGETS][i % N_TARGETS];

		bytes_put_u64(out, m->order[0]);
		bytes_put_u64(out, m->order[1]);
		bytes_put(out, m->from, sizeof(m->from));
		bytes_put(out, m->to, sizeof(m->to));
		bytes_put(out, m->points, map_size(m, i % N_TARGETS) * sizeof(*m->points));
	}
}

struct gls_maps *gls_maps_load(struct cursor *in)
{
	struct gls_maps *maps;

	if (!cursor_u64(in) || in->failed)
		return NULL;
	maps = calloc(1, sizeof(*maps));
	in->failed |= !maps;
	for (unsigned i = 0; i < 2 * N_TARGETS && !in->failed; i++) {
		struct map *m = &maps->map[i / N_TARGETS][i % N_TARGETS], loaded = { .points = NULL };
		uint64_t order[2] = { cursor_u64(in), cursor_u64(in) };

		cursor_copy(in, loaded.from, sizeof(loaded.from));
		cursor_copy(in, loaded.to, sizeof(loaded.to));
		if (order[0] > MAX_ORDER || order[1] > MAX_ORDER || !order[0] != !order[1])
			in->failed = 1;
		if (in->failed || !order[0])
			continue;
		loaded.order[0] = (uint32_t)order[0];
		loaded.order[1] = (uint32_t)order[1];
		loaded.points = calloc(map_size(&loaded, i % N_TARGETS), sizeof(*loaded.points));
		if (loaded.points)
			cursor_copy(in, loaded.points, map_size(&loaded, i % N_TARGETS) * sizeof(*loaded.points));
		else
			in->failed = 1;
		*m = loaded;
	}
	return maps;
}

/* ---- Map1 and Map2, sec. 5.1 ---- */

/* Arguments: target, then from, to, stride and order for each dimension, then the points. */
GLS_FAMILY(glMap, STATE)
{
	const unsigned which = gls_commands[x->command].suffix.n - 1u; /* 0: Map1, 1: Map2 */
	uint32_t target = arg_u(c, 0) - (which ? GL_MAP2_COLOR_4 : GL_MAP1_COLOR_4);
	struct map new = { .order = { 1, 1 } };
	int64_t stride[2] = { 0, 0 };
	uint64_t n_values;
	const struct trace_value *values = arg_items(c, which ? 9 : 5, &n_values);
	unsigned size;

	if (gls_refuses(x, st, target >= N_TARGETS, GL_INVALID_ENUM))
		return;
	size = sizes[target];
	for (unsigned d = 0; d <= which; d++) {
		int64_t order = arg_i(c, 4 + 4 * d);

		new.from[d] = arg_f(c, 1 + 4 * d);
		new.to[d] = arg_f(c, 2 + 4 * d);
		stride[d] = arg_i(c, 3 + 4 * d);
		if (new.from[d] == new.to[d] || stride[d] < (int64_t)size || order < 1 || order > MAX_ORDER) {
			gls_error(x, st, GL_INVALID_VALUE);
			return;
		}
		new.order[d] = (uint32_t)order;
	}
	if (!st->maps && !(st->maps = calloc(1, sizeof(*st->maps)))) {
		gls_out_of_memory(x, sizeof(*st->maps));
		return;
	}
	new.points = calloc((size_t)new.order[0] * new.order[1] * size, sizeof(float));
	if (!new.points) {
		gls_out_of_memory(x, (size_t)new.order[0] * new.order[1] * size * sizeof(float));
		return;
	}
	for (uint32_t i = 0; i < new.order[0]; i++)
		for (uint32_t j = 0; j < new.order[1]; j++)
			for (unsigned k = 0; k < size; k++) {
				uint64_t at = i * (uint64_t)stride[0] + j * (uint64_t)stride[1] + k;

				if (values && at < n_values)
					new.points[(i * new.order[1] + j) * size + k] = (float)gls_value_double(&values[at]);
			}
	free(st->maps->map[which][target].points);
	st->maps->map[which][target] = new;
}

/* ---- evaluation ---- */

/* A curve of n points `stride` floats apart, at t: Horner's scheme over Bernstein polynomials, as Mesa sums them. */
static void curve(const float *points, uint32_t n, size_t stride, unsigned size, float t, float *out)
{
	float binomial = (float)(n - 1), s = 1 - t, power = t * t;

	for (unsigned k = 0; k < size; k++)
		out[k] = n == 1 ? points[k] : s * points[k] + binomial * t * points[stride + k];
	for (uint32_t i = 2; i < n; i++, power *= t) {
		binomial *= (float)(n - i);
		binomial *= 1.0f / (float)i;
		for (unsigned k = 0; k < size; k++)
			out[k] = s * out[k] + binomial * power * points[i * stride + k];
	}
}

/* A surface at (u, v), evaluated first in the direction with fewer points. */
static void surface(const float *points, const uint32_t order[2], unsigned size, const float t[2], float *out)
{
	float between[MAX_ORDER * 4];

	if (order[1] > order[0]) {
		for (uint32_t j = 0; j < order[1]; j++)
			curve(points + j * size, order[0], (size_t)order[1] * size, size, t[0], between + j * size);
		curve(between, order[1], size, size, t[1], out);
	} else {
		for (uint32_t i = 0; i < order[0]; i++)
			curve(points + (size_t)i * order[1] * size, order[1], size, size, t[1], between + i * size);
		curve(between, order[0], size, size, t[0], out);
	}
}

/* The derivative of a surface in direction d: the surface of its points' differences, one fewer in that direction. */
static void derivative(const struct map *m, unsigned size, const float t[2], unsigned d, float *out)
{
	float points[MAX_ORDER * MAX_ORDER * 4];
	uint32_t order[2] = { m->order[0] - (d == 0), m->order[1] - (d == 1) };
	size_t step = d == 0 ? m->order[1] * size : size;

	memset(out, 0, 4 * sizeof(*out));
	if (m->order[d] < 2)
		return;
	for (uint32_t i = 0; i < order[0]; i++)
		for (uint32_t j = 0; j < order[1]; j++)
			for (unsigned k = 0; k < size; k++) {
				const float *p = m->points + ((size_t)i * m->order[1] + j) * size + k;

				points[((size_t)i * order[1] + j) * size + k] = (p[step] - p[0]) * (float)order[d];
			}
	surface(points, order, size, t, out);
}

/* Analytic normals (sec. 5.1, AUTO_NORMAL): perpendicular to the surface at a point. */
static void auto_normal(const struct map *m, unsigned size, const float t[2], const float at[4], float normal[4])
{
	float du[4], dv[4], length;

	derivative(m, size, t, 0, du);
	derivative(m, size, t, 1, dv);
	for (unsigned k = 0; k < 3 && size == 4; k++) {
		du[k] = du[k] * at[3] - du[3] * at[k];
		dv[k] = dv[k] * at[3] - dv[3] * at[k];
	}
	normal[0] = du[1] * dv[2] - du[2] * dv[1];
	normal[1] = du[2] * dv[0] - du[0] * dv[2];
	normal[2] = du[0] * dv[1] - du[1] * dv[0];
	normal[3] = 1;
	length = sqrtf(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
	for (unsigned k = 0; k < 3 && length > 0; k++)
		normal[k] /= length;
}

/* Evaluate a map if it is enabled. @return 0: it is disabled */
static int evaluate(const struct gls_state *st, unsigned which, unsigned target, const float u[2], float t[2],
                    float out[4])
{
	const struct gls_evaluator *e = &st->a.evaluator;
	const struct map *m = st->maps ? &st->maps->map[which][target] : NULL;

	if (!((which ? e->map2 : e->map1) >> target & 1))
		return 0;
	if (!m || !m->points) {
		memcpy(out, initial[target], sizes[target] * sizeof(float));
		return 1;
	}
	for (unsigned d = 0; d <= which; d++)
		t[d] = (u[d] - m->from[d]) / (m->to[d] - m->from[d]);
	if (which)
		surface(m->points, m->order, sizes[target], t, out);
	else
		curve(m->points, m->order[0], sizes[target], sizes[target], t[0], out);
	return 1;
}

/*
 * EvalCoord: enabled maps replace current values for this one vertex; the current values themselves do not change (sec.
 * 5.1).
 */
static void eval_coord(struct gls_exec *x, struct gls_state *st, unsigned which, float u, float v)
{
	float at[2] = { u, v }, t[2] = { 0, 0 }, position[4] = { 0, 0, 0, 1 }, value[4];
	struct gls_current saved = st->a.current;
	unsigned vertex = VERTEX_4;

	if (!st->begin_mode)
		return;
	if (!evaluate(st, which, VERTEX_4, at, t, position)) {
		vertex = VERTEX_3;
		if (!evaluate(st, which, VERTEX_3, at, t, position))
			return;
	}
	if (which && st->a.evaluator.auto_normal && st->maps && st->maps->map[1][vertex].points) {
		auto_normal(&st->maps->map[1][vertex], sizes[vertex], t, position, value);
		gls_set_attribute(x, st, GLS_ATTR_NORMAL, value);
	} else if (evaluate(st, which, NORMAL, at, t, value)) {
		value[3] = 1;
		gls_set_attribute(x, st, GLS_ATTR_NORMAL, value);
	}
	if (evaluate(st, which, COLOR_4, at, t, value))
		gls_set_attribute(x, st, GLS_ATTR_COLOR, value);
	for (unsigned target = TEXTURE_COORD_4; target >= TEXTURE_COORD_1; target--) {
		memcpy(value, (float[4]){ 0, 0, 0, 1 }, sizeof(value));
		if (!evaluate(st, which, target, at, t, value))
			continue;
		gls_set_attribute(x, st, GLS_ATTR_TEXCOORD, value);
		break;
	}
	gls_vertex(x, st, position);
	for (unsigned a = 0; a < N_GLS_ATTRIBUTES; a++)
		if (memcmp(saved.attribute[a], st->a.current.attribute[a], 16) != 0)
			gls_set_attribute(x, st, a, saved.attribute[a]);
}

GLS_FAMILY(glEvalCoord, INSIDE)
{
	const struct gls_suffix suffix = gls_commands[x->command].suffix;
	float u[2] = { 0, 0 };

	if (suffix.array)
		arg_floats(c, 0, u, suffix.n);
	for (unsigned i = 0; i < suffix.n && !suffix.array; i++)
		u[i] = arg_f(c, i);
	eval_coord(x, st, suffix.n - 1u, u[0], u[1]);
}

/* ---- grids ---- */

static void set_grid(struct gls_exec *x, struct gls_state *st, int64_t segments, float from, float to, int32_t *n,
                     float grid[2])
{
	if (gls_refuses(x, st, segments < 1, GL_INVALID_VALUE))
		return;
	*n = (int32_t)(segments < INT32_MAX ? segments : INT32_MAX);
	grid[0] = from;
	grid[1] = to;
}

GLS_FAMILY(glMapGrid, STATE)
{
	struct gls_evaluator *e = &st->a.evaluator;

	if (gls_commands[x->command].suffix.n == 1) {
		set_grid(x, st, arg_i(c, 0), arg_f(c, 1), arg_f(c, 2), &e->grid1_segments, e->grid1);
		return;
	}
	if (gls_refuses(x, st, arg_i(c, 3) < 1, GL_INVALID_VALUE))
		return;
	set_grid(x, st, arg_i(c, 0), arg_f(c, 1), arg_f(c, 2), &e->grid2_segments[0], e->grid2);
	if (arg_i(c, 0) >= 1)
		set_grid(x, st, arg_i(c, 3), arg_f(c, 4), arg_f(c, 5), &e->grid2_segments[1], e->grid2 + 2);
}

/* Coordinate i of the grid; the last one is exact (sec. 5.1). */
static float grid_at(const float grid[2], int32_t segments, int64_t i)
{
	return i == segments ? grid[1] : grid[0] + (float)i * ((grid[1] - grid[0]) / (float)segments);
}

static void point_1(struct gls_exec *x, struct gls_state *st, int64_t i)
{
	const struct gls_evaluator *e = &st->a.evaluator;

	eval_coord(x, st, 0, grid_at(e->grid1, e->grid1_segments, i), 0);
}

static void point_2(struct gls_exec *x, struct gls_state *st, int64_t i, int64_t j)
{
	const struct gls_evaluator *e = &st->a.evaluator;

	eval_coord(x, st, 1, grid_at(e->grid2, e->grid2_segments[0], i), grid_at(e->grid2 + 2, e->grid2_segments[1], j));
}

GLS_HANDLER(glEvalPoint1, INSIDE) { point_1(x, st, arg_i(c, 0)); }
GLS_HANDLER(glEvalPoint2, INSIDE) { point_2(x, st, arg_i(c, 0), arg_i(c, 1)); }

/* 1 if there is something to draw, within limits: 2^20 points per mesh, four times as many per frame. */
static int mesh_fits(struct gls_exec *x, int64_t across, int64_t along)
{
	if (!x->want || across <= 0 || along <= 0)
		return 0;
	if ((double)across * (double)along <= GLS_MAX_PENDING_VERTICES)
		return !gls_is_beyond_measure(x, (uint64_t)(across * along) / POINTS_A_REPEAT, "evaluated meshes without end");
	gls_unsupported(x, "evaluated meshes of more than 2^20 points");
	return 0;
}

GLS_HANDLER(glEvalMesh1, STATE)
{
	uint32_t mode = arg_u(c, 0);

	if (gls_refuses(x, st, mode != GL_POINT && mode != GL_LINE, GL_INVALID_ENUM))
		return;
	if (!mesh_fits(x, arg_i32(c, 2) - arg_i32(c, 1) + 1, 1))
		return;
	gls_begin(x, st, mode == GL_POINT ? GL_POINTS : GL_LINE_STRIP);
	for (int64_t i = arg_i32(c, 1); i <= arg_i32(c, 2); i++)
		point_1(x, st, i);
	gls_end(x, st);
}

/*
 * Sec. 5.1: points, lines in both directions, or triangle strips (Mesa uses these where the specification has quad
 * strips).
 */
GLS_HANDLER(glEvalMesh2, STATE)
{
	uint32_t mode = arg_u(c, 0);
	int64_t i1 = arg_i32(c, 1), i2 = arg_i32(c, 2), j1 = arg_i32(c, 3), j2 = arg_i32(c, 4);

	if (gls_refuses(x, st, mode != GL_POINT && mode != GL_LINE && mode != GL_FILL, GL_INVALID_ENUM))
		return;
	if (!mesh_fits(x, i2 - i1 + 1, j2 - j1 + 1))
		return;
	for (int64_t j = j1; j <= j2 - (mode == GL_FILL); j++) {
		gls_begin(x, st, mode == GL_POINT ? GL_POINTS : mode == GL_LINE ? GL_LINE_STRIP : GL_TRIANGLE_STRIP);
		for (int64_t i = i1; i <= i2; i++) {
			point_2(x, st, i, j);
			if (mode == GL_FILL)
				point_2(x, st, i, j + 1);
		}
		gls_end(x, st);
	}
	for (int64_t i = i1; i <= i2 && mode == GL_LINE; i++) {
		gls_begin(x, st, GL_LINE_STRIP);
		for (int64_t j = j1; j <= j2; j++)
			point_2(x, st, i, j);
		gls_end(x, st);
	}
}
