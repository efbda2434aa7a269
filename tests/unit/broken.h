/*
 * Closed meshes of many kinds, and ways to break them as programs do. For tests of scene/repair. Everything is derived
 * from a seed.
 */
#pragma once

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"

enum { BROKEN_MOST = 60000, BROKEN_KINDS = 6 };

struct broken {
	uint64_t random;
	double (*points)[3]; /* one for each triangle corner, or shared: see index */
	uint32_t *index;
	uint32_t n_points, n_triangles;
	float *positions; /* [n_points][4] */
	struct scene_mesh mesh;
};

static inline double broken_next(struct broken *b) /* [0,1) */
{
	b->random ^= b->random << 13;
	b->random ^= b->random >> 7;
	b->random ^= b->random << 17;
	return (double)(b->random >> 11) / 9007199254740992.0;
}

static inline uint32_t broken_below(struct broken *b, uint32_t n)
{
	return (uint32_t)(broken_next(b) * n);
}

static inline uint32_t broken_point(struct broken *b, double x, double y, double z)
{
	memcpy(b->points[b->n_points], (double[3]){ x, y, z }, sizeof(*b->points));
	return b->n_points++;
}

static inline void broken_triangle(struct broken *b, uint32_t one, uint32_t two, uint32_t three)
{
	memcpy(b->index + 3 * (size_t)b->n_triangles++, (uint32_t[3]){ one, two, three }, 3 * sizeof(*b->index));
}

static inline void broken_quad(struct broken *b, uint32_t one, uint32_t two, uint32_t three, uint32_t four)
{
	broken_triangle(b, one, two, three);
	broken_triangle(b, one, three, four);
}

/* --- Closed meshes, counter-clockwise outside -------------------------------------------------------------------- */

/*
 * A chain of rings, closed at both ends by a pole, or joined to itself. place: position of ring i of n, vertex k of m
 */
static inline void broken_rings(struct broken *b, uint32_t n, uint32_t m, int round,
                                void (*place)(const double *how, double i, double k, double out[3]), const double *how)
{
	const uint32_t first = b->n_points;
	double at[3];

	for (uint32_t i = 0; i < n; i++)
		for (uint32_t k = 0; k < m; k++) {
			place(how, round ? (double)i / n : (i + 1.0) / (n + 1), (double)k / m, at);
			broken_point(b, at[0], at[1], at[2]);
		}
	for (uint32_t i = 0; i < (round ? n : n - 1); i++)
		for (uint32_t k = 0; k < m; k++) {
			const uint32_t on = (i + 1) % n * m, next = (k + 1) % m;

			broken_quad(b, first + i * m + k, first + i * m + next, first + on + next, first + on + k);
		}
	for (int end = 0; end < 2 && !round; end++) {
		uint32_t pole;

		place(how, end, 0, at);
		pole = broken_point(b, at[0], at[1], at[2]);
		for (uint32_t k = 0; k < m; k++) {
			const uint32_t one = first + (end ? (n - 1) * m : 0) + k, two = first + (end ? (n - 1) * m : 0) + (k + 1) % m;

			broken_triangle(b, pole, end ? one : two, end ? two : one);
		}
	}
}

static inline void broken_on_ball(const double *how, double i, double k, double out[3])
{
	out[0] = how[0] * sin(M_PI * i) * cos(2 * M_PI * k);
	out[1] = how[1] * sin(M_PI * i) * sin(2 * M_PI * k);
	out[2] = how[2] * -cos(M_PI * i);
}

static inline void broken_on_torus(const double *how, double i, double k, double out[3])
{
	const double off = 1 + how[0] * cos(2 * M_PI * k);

	out[0] = off * cos(2 * M_PI * i);
	out[1] = off * sin(2 * M_PI * i);
	out[2] = how[0] * -sin(2 * M_PI * k);
}

/* A prism: two rings with sharp edges; the poles are the centres of its ends. */
static inline void broken_on_prism(const double *how, double i, double k, double out[3])
{
	const double off = i == 0 || i == 1 ? 0 : i < 0.5 ? how[0] : how[1];

	out[0] = off * cos(2 * M_PI * k);
	out[1] = off * sin(2 * M_PI * k);
	out[2] = i < 0.5 ? 0 : how[2];
}

/*
 * Grid cells put together: boxes cut into squares, L, T and U shapes, rooms with cavities, bodies that touch along an
 * edge. There is a face between a filled cell and an empty one.
 */
static inline void broken_cells(struct broken *b, const uint32_t size[3], double share, const double *at[3])
{
	const uint32_t first = b->n_points, row = size[0] + 1, sheet = row * (size[1] + 1);
	uint8_t there[8][8][8] = { { { 0 } } };
	int any = 0;

	while (!any)
		for (uint32_t i = 0; i < size[0] * size[1] * size[2]; i++)
			any |= there[1 + i % size[0]][1 + i / size[0] % size[1]][1 + i / size[0] / size[1]] = broken_next(b) < share;
	for (uint32_t z = 0; z <= size[2]; z++)
		for (uint32_t y = 0; y <= size[1]; y++)
			for (uint32_t x = 0; x <= size[0]; x++)
				broken_point(b, at[0][x], at[1][y], at[2][z]);
	for (uint32_t i = 0; i < size[0] * size[1] * size[2] * 6; i++) {
		const uint32_t cell[3] = { i / 6 % size[0], i / 6 / size[0] % size[1], i / 6 / size[0] / size[1] },
			       axis = i % 3, far = i / 3 % 2;
		const uint32_t steps[3] = { 1, row, sheet }, u = steps[(axis + 1) % 3], v = steps[(axis + 2) % 3];
		const uint32_t corner = first + cell[0] + cell[1] * row + cell[2] * sheet + far * steps[axis];
		uint32_t next[3] = { cell[0] + 1, cell[1] + 1, cell[2] + 1 };

		next[axis] += far ? 1 : (uint32_t)-1;
		if (!there[cell[0] + 1][cell[1] + 1][cell[2] + 1] || there[next[0]][next[1]][next[2]])
			continue;
		if (far)
			broken_quad(b, corner, corner + u, corner + u + v, corner + v);
		else
			broken_quad(b, corner, corner + v, corner + u + v, corner + u);
	}
}

static inline void broken_make(struct broken *b, uint32_t kind)
{
	const double how[3] = { 0.3 + broken_next(b), 0.3 + broken_next(b), 0.3 + broken_next(b) };
	const uint32_t n = 3 + broken_below(b, 14), m = 3 + broken_below(b, 22);
	const double thin = 0.1 + 0.6 * broken_next(b);
	double lines[3][8];
	uint32_t size[3];

	for (int k = 0; k < 3; k++) {
		size[k] = 1 + broken_below(b, 5);
		lines[k][0] = 0;
		for (int i = 1; i < 8; i++)
			lines[k][i] = lines[k][i - 1] + 0.2 + broken_next(b);
	}
	if (kind == 0)
		broken_rings(b, n, m, 0, broken_on_ball, how);
	else if (kind == 1)
		broken_rings(b, n, m, 1, broken_on_torus, &thin);
	else if (kind == 2)
		broken_rings(b, 2, m, 0, broken_on_prism, how);
	else if (kind == 5) { /* a ball inside a ball: glass with air inside */
		const double inner[3] = { 0.5 * how[0], 0.5 * how[1], 0.5 * how[2] };
		const uint32_t from = b->n_triangles;

		broken_rings(b, n, m, 0, broken_on_ball, how);
		for (uint32_t outer = b->n_triangles, i = (broken_rings(b, n, m, 0, broken_on_ball, inner), outer);
		     i < b->n_triangles && from < outer; i++) {
			const uint32_t kept = b->index[3 * i];

			b->index[3 * i] = b->index[3 * i + 1];
			b->index[3 * i + 1] = kept;
		}
	} else
		broken_cells(b, size, kind == 3 ? 1 : 0.6, (const double *[3]){ lines[0], lines[1], lines[2] });
}

/* --- Placement, in floats ---------------------------------------------------------------------------------------- */

/* Rotate, move and scale; positions are then rounded to floats. @return the diagonal of its bounding box */
static inline double broken_place(struct broken *b)
{
	const double scale = pow(10, -2 + 5 * broken_next(b)), turn = 6.3 * broken_next(b), tilt = 6.3 * broken_next(b);
	const int turns = broken_below(b, 3) > 0; /* a third stays aligned with the axes */
	double away[3], low[3] = { 1e30, 1e30, 1e30 }, high[3] = { -1e30, -1e30, -1e30 };

	for (int k = 0; k < 3; k++)
		away[k] = broken_below(b, 2) ? 6 * (broken_next(b) - 0.5) : 0;
	for (uint32_t p = 0; p < b->n_points; p++) {
		const double *at = b->points[p];
		const double x = turns ? at[0] * cos(turn) - at[1] * sin(turn) : at[0],
			     y = turns ? at[0] * sin(turn) + at[1] * cos(turn) : at[1], z = at[2];
		const double placed[3] = { x, turns ? y * cos(tilt) - z * sin(tilt) : y, turns ? y * sin(tilt) + z * cos(tilt) : z };

		for (int k = 0; k < 3; k++)
			b->points[p][k] = (float)(scale * (placed[k] + away[k]));
	}
	for (uint32_t i = 0; i < 3 * b->n_triangles; i++) /* a grid has vertices without triangles */
		for (int k = 0; k < 3; k++) {
			low[k] = fmin(low[k], b->points[b->index[i]][k]);
			high[k] = fmax(high[k], b->points[b->index[i]][k]);
		}
	return sqrt(pow(high[0] - low[0], 2) + pow(high[1] - low[1], 2) + pow(high[2] - low[2], 2));
}

static inline double broken_volume(const struct broken *b)
{
	const double *o = b->points[0];
	double sum = 0;

	for (uint32_t f = 0; f < b->n_triangles; f++) {
		double e[3][3];

		for (int c = 0; c < 3; c++)
			for (int k = 0; k < 3; k++)
				e[c][k] = b->points[b->index[3 * f + (uint32_t)c]][k] - o[k];
		for (int k = 0; k < 3; k++)
			sum += e[0][k] * (e[1][(k + 1) % 3] * e[2][(k + 2) % 3] - e[1][(k + 2) % 3] * e[2][(k + 1) % 3]) / 6;
	}
	return sum;
}

/* --- Ways to break it -------------------------------------------------------------------------------------------- */

/* Cut triangles at places along one of their edges; the neighbour is not cut, or cut elsewhere. */
static inline void broken_cut(struct broken *b, double share)
{
	const uint32_t n = b->n_triangles;

	for (uint32_t f = 0; f < n; f++) {
		uint32_t triangle = f;

		for (uint32_t times = broken_next(b) < share ? 1 + broken_below(b, 3) : 0; times; times--) {
			uint32_t *v = b->index + 3 * (size_t)triangle;
			const uint32_t k = broken_below(b, 3), one = v[k], two = v[(k + 1) % 3], three = v[(k + 2) % 3];
			const double along = 0.15 + 0.7 * broken_next(b);
			double at[3];
			uint32_t middle;

			for (int i = 0; i < 3; i++)
				at[i] = (float)(b->points[one][i] + along * (b->points[two][i] - b->points[one][i]));
			middle = broken_point(b, at[0], at[1], at[2]);
			memcpy(v, (uint32_t[3]){ one, middle, three }, 3 * sizeof(*v));
			broken_triangle(b, middle, two, three);
			triangle = broken_below(b, 2) ? triangle : b->n_triangles - 1;
		}
	}
}

/* Duplicate vertices, as programs with normals or texture coordinates do. */
static inline void broken_split(struct broken *b, double share)
{
	for (uint32_t i = 0; i < 3 * b->n_triangles; i++)
		if (broken_next(b) < share) {
			const double *at = b->points[b->index[i]];

			b->index[i] = broken_point(b, at[0], at[1], at[2]);
		}
}

/* Move each vertex by at most `most` in any direction. */
static inline void broken_jitter(struct broken *b, double most)
{
	for (uint32_t p = 0; p < b->n_points; p++) {
		double way[3], square = 2;

		while (square > 1) {
			square = 0;
			for (int k = 0; k < 3; k++) {
				way[k] = 2 * broken_next(b) - 1;
				square += way[k] * way[k];
			}
		}
		for (int k = 0; k < 3; k++)
			b->points[p][k] = (float)(b->points[p][k] + most * way[k]);
	}
}

static inline void broken_turn(struct broken *b, uint32_t f)
{
	const uint32_t kept = b->index[3 * f];

	b->index[3 * f] = b->index[3 * f + 1];
	b->index[3 * f + 1] = kept;
}

static inline void broken_double(struct broken *b, double share)
{
	for (uint32_t f = 0, n = b->n_triangles; f < n; f++)
		if (broken_next(b) < share) {
			broken_triangle(b, b->index[3 * f], b->index[3 * f + 1], b->index[3 * f + 2]);
			if (broken_below(b, 2))
				broken_turn(b, b->n_triangles - 1);
		}
}

/* Add triangles without area: with two vertices, or three on a line. */
static inline void broken_slivers(struct broken *b, double share)
{
	for (uint32_t f = 0, n = b->n_triangles; f < n; f++) {
		const uint32_t one = b->index[3 * f], two = b->index[3 * f + 1];
		const double along = 0.1 + 0.8 * broken_next(b), *from = b->points[one], *to = b->points[two];

		if (broken_next(b) >= share)
			continue;
		if (broken_below(b, 2))
			broken_triangle(b, one, two, two);
		else
			broken_triangle(b, one, two,
			                broken_point(b, (float)(from[0] + along * (to[0] - from[0])),
			                             (float)(from[1] + along * (to[1] - from[1])),
			                             (float)(from[2] + along * (to[2] - from[2]))));
	}
}

/* Reorder triangles and rotate their vertices: several strips and fans instead of one. */
static inline void broken_shuffle(struct broken *b)
{
	for (uint32_t f = b->n_triangles; f > 1; f--) {
		const uint32_t other = broken_below(b, f), first = broken_below(b, 3);
		uint32_t kept[3], *one = b->index + 3 * (size_t)(f - 1), *two = b->index + 3 * (size_t)other;

		for (uint32_t k = 0; k < 3; k++)
			kept[k] = one[(k + first) % 3];
		memmove(one, two, sizeof(kept));
		memcpy(two, kept, sizeof(kept));
	}
}

static inline void broken_free(struct broken *b)
{
	free(b->points);
	free(b->index);
	free(b->positions);
}

/** Allocate memory for a mesh, which is made later. */
static inline void broken_init(struct broken *b, uint64_t seed)
{
	*b = (struct broken){ .random = seed * 0x9E3779B97F4A7C15u + 1 };
	b->points = malloc(4 * BROKEN_MOST * sizeof(*b->points));
	b->index = malloc(4 * BROKEN_MOST * 3 * sizeof(*b->index));
	for (int i = 0; i < 8; i++)
		broken_next(b);
}

/** The mesh in a scene's format. */
static inline const struct scene_mesh *broken_mesh(struct broken *b)
{
	b->positions = malloc((size_t)b->n_points * 4 * sizeof(float));
	for (uint32_t p = 0; p < b->n_points; p++)
		for (int k = 0; k < 4; k++)
			b->positions[4 * (size_t)p + (size_t)k] = k < 3 ? (float)b->points[p][k] : 1;
	b->mesh = (struct scene_mesh){ .kind = SCENE_TRIANGLES, .vertex_count = b->n_points, .primitive_count = b->n_triangles,
		                       .position = b->positions, .index = b->index };
	return &b->mesh;
}

/**
 * A closed mesh, broken in one or more of these ways at random.
 * @param weld    the tolerance as a share of the size; vertices move by less than half of it, so that two copies of one
 * vertex stay within it
 * @param volume  receives the volume before
 */
static inline const struct scene_mesh *broken_random(struct broken *b, uint64_t seed, double weld, double *volume)
{
	double size;
	uint32_t ways;

	broken_init(b, seed);
	broken_make(b, (uint32_t)(seed % BROKEN_KINDS));
	size = broken_place(b);
	*volume = broken_volume(b);
	ways = 1 + broken_below(b, 63);
	if (ways & 1)
		broken_cut(b, 0.5 * broken_next(b));
	if (ways & 2)
		broken_double(b, 0.2 * broken_next(b));
	if (ways & 4)
		broken_slivers(b, 0.2 * broken_next(b));
	if (ways & 8)
		broken_split(b, broken_next(b));
	if (ways & 16)
		broken_jitter(b, 0.5 * weld * size * broken_next(b));
	for (uint32_t f = 0; f < b->n_triangles && ways & 32; f++)
		if (broken_below(b, 3) == 0)
			broken_turn(b, f);
	broken_shuffle(b);
	return broken_mesh(b);
}
