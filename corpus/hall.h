/*
 * Geometry of the hall (hall.c): a generated vaulted hall between two rows of fluted columns, with exactly 262,267
 * triangles, as many as the Sponza model used for comparing ray tracers. Does not use OpenGL.
 */
#pragma once

#include <stddef.h>

#include "mesh.h"

enum { N_TRIANGLES = 262267, COLUMNS_PER_ROW = 14, ROSETTE_PETALS = 379 };
enum part { PART_FLOOR, PART_STONE, PART_MARBLE, N_PARTS };

static const float turn = 6.28318530718f;
static const float half_length = 28, half_width = 7, wall_height = 7, column_x = 4, column_height = 5, column_pitch = 4;

struct vertex {
	float texcoord[2], normal[3], position[3];
};

/* One part of the hall, with one texture. */
static struct part_mesh {
	struct vertex *vertices;
	unsigned *indices;
	size_t n_vertices, n_indices;
} parts[N_PARTS];

/* A surface over u and v in [0,1]; `at` moves it to its place. */
typedef void surface(float u, float v, const float at[2], float out[3]);

static void floor_surface(float u, float v, const float at[2], float out[3])
{
	(void)at;
	out[0] = half_width * (2 * u - 1);
	out[1] = 0;
	out[2] = half_length * (1 - 2 * v);
}

/** A side wall; at[0] is -1 for the left one, 1 for the right one. */
static void wall_surface(float u, float v, const float at[2], float out[3])
{
	out[0] = at[0] * half_width;
	out[1] = wall_height * v;
	out[2] = at[0] * half_length * (2 * u - 1);
}

/** An end wall; at[0] is -1 for the far one. */
static void end_surface(float u, float v, const float at[2], float out[3])
{
	float x = 2 * u - 1;

	out[0] = -at[0] * half_width * x;
	out[1] = v * (wall_height + 3 * sqrtf(fmaxf(0, 1 - x * x)));
	out[2] = at[0] * half_length;
}

static void vault_surface(float u, float v, const float at[2], float out[3])
{
	(void)at;
	out[0] = half_width * cosf(turn / 2 * u);
	out[1] = wall_height + 3 * sinf(turn / 2 * u);
	out[2] = half_length * (1 - 2 * v);
}

/** Base, fluted and slightly swelling shaft, capital. */
static void column_surface(float u, float v, const float at[2], float out[3])
{
	float shaft = fminf(1, fmaxf(0, (v - 0.1f) / 0.8f));
	float radius = 0.42f - 0.08f * shaft + 0.03f * sinf(turn / 2 * shaft);

	if (v < 0.1f)
		radius += 0.12f * fabsf(cosf(turn * v * 7.5f));
	else if (v > 0.9f)
		radius += 0.22f * (v - 0.9f) * 10;
	else
		radius -= 0.025f * fabsf(sinf(turn * 8 * u)) * sinf(turn / 2 * shaft);
	out[0] = at[0] - radius * cosf(turn * u);
	out[1] = column_height * v;
	out[2] = at[1] + radius * sinf(turn * u);
}

/** The stone band between two columns: a half ring, its section a rounded square. */
static void arch_surface(float u, float v, const float at[2], float out[3])
{
	float section = turn * v, c = cosf(section), s = sinf(section);
	float radius = column_pitch / 2 + 0.25f * c / sqrtf(sqrtf(c * c * c * c + s * s * s * s));

	out[0] = at[0] + 0.3f * s / sqrtf(sqrtf(c * c * c * c + s * s * s * s));
	out[1] = column_height + radius * sinf(turn / 2 * u) * 0.9f;
	out[2] = at[1] - radius * cosf(turn / 2 * u);
}

/** A point of the surface, with a normal from finite differences. */
static struct vertex sample(surface *f, float u, float v, const float at[2])
{
	const float step = 1e-3f;
	struct vertex out = { .texcoord = { 0 } };
	float du[2][3], dv[2][3], length, n[3];

	f(u, v, at, out.position);
	f(u - step, v, at, du[0]);
	f(u + step, v, at, du[1]);
	f(u, v - step, at, dv[0]);
	f(u, v + step, at, dv[1]);
	for (int k = 0; k < 3; k++) {
		int a = (k + 1) % 3, b = (k + 2) % 3;

		n[k] = (du[1][a] - du[0][a]) * (dv[1][b] - dv[0][b]) - (du[1][b] - du[0][b]) * (dv[1][a] - dv[0][a]);
	}
	length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
	for (int k = 0; k < 3; k++)
		out.normal[k] = length > 0 ? n[k] / length : 0;
	return out;
}

static unsigned add_vertex(struct part_mesh *part, const struct vertex *v)
{
	part->vertices = (struct vertex *)mesh_grow(part->vertices, part->n_vertices, sizeof(*part->vertices));
	part->vertices[part->n_vertices] = *v;
	return (unsigned)part->n_vertices++;
}

static void add_triangle(struct part_mesh *part, unsigned a, unsigned b, unsigned c)
{
	const unsigned corners[3] = { a, b, c };

	for (int i = 0; i < 3; i++) {
		part->indices = (unsigned *)mesh_grow(part->indices, part->n_indices, sizeof(*part->indices));
		part->indices[part->n_indices++] = corners[i];
	}
}

/** A surface as a grid of 2 * nu * nv triangles; its texture repeats repeat_u by repeat_v times. */
static void add_grid(enum part where, surface *f, float at0, float at1, unsigned nu, unsigned nv, float repeat_u,
                     float repeat_v)
{
	struct part_mesh *part = &parts[where];
	unsigned first = (unsigned)part->n_vertices;

	for (unsigned j = 0; j <= nv; j++)
		for (unsigned i = 0; i <= nu; i++) {
			float u = (float)i / (float)nu, v = (float)j / (float)nv;
			struct vertex vertex = sample(f, u, v, (const float[2]){ at0, at1 });

			vertex.texcoord[0] = repeat_u * u;
			vertex.texcoord[1] = repeat_v * v;
			add_vertex(part, &vertex);
		}
	for (unsigned j = 0; j < nv; j++)
		for (unsigned i = 0; i < nu; i++) {
			unsigned a = first + j * (nu + 1) + i, c = a + nu + 1;

			add_triangle(part, a, a + 1, c + 1);
			add_triangle(part, a, c + 1, c);
		}
}

/** The top of a round slab: a fan of ROSETTE_PETALS triangles, which completes N_TRIANGLES. */
static void add_rosette(void)
{
	struct vertex v = { { 0.5f, 0.5f }, { 0, 1, 0 }, { 0, 0.05f, 0 } };
	unsigned center = add_vertex(&parts[PART_MARBLE], &v), previous = 0;

	for (unsigned i = 0; i <= ROSETTE_PETALS; i++) {
		float a = turn * (float)i / ROSETTE_PETALS;
		unsigned corner;

		v.position[0] = 1.6f * cosf(a);
		v.position[2] = -1.6f * sinf(a);
		v.texcoord[0] = 0.5f + 0.5f * cosf(a);
		v.texcoord[1] = 0.5f + 0.5f * sinf(a);
		corner = add_vertex(&parts[PART_MARBLE], &v);
		if (i > 0)
			add_triangle(&parts[PART_MARBLE], center, previous, corner);
		previous = corner;
	}
}

/** The knot on the slab. */
static void add_statue(void)
{
	struct part_mesh *part = &parts[PART_MARBLE];
	unsigned first = (unsigned)part->n_vertices;
	struct mesh knot = { 0 };

	mesh_make_knot(&knot, 512, 16);
	mesh_fit(&knot);
	mesh_add_normals(&knot);
	for (size_t i = 0; i < knot.n_vertices; i++) {
		const float *p = knot.positions[i], *n = knot.normals[i];
		struct vertex v = { { 2 * p[0], 2 * p[1] }, { n[0], n[1], n[2] },
			            { 1.2f * p[0], 1.3f + 1.2f * p[1], 1.2f * p[2] } };

		add_vertex(part, &v);
	}
	for (size_t i = 0; i < knot.n_triangles; i++)
		add_triangle(part, first + knot.triangles[i][0], first + knot.triangles[i][1], first + knot.triangles[i][2]);
	free(knot.positions);
	free(knot.normals);
	free(knot.triangles);
}

/** Fill in `parts`, in world space: y up, the floor at 0. Exits with a line on standard error on failure. */
static void build_hall(void)
{
	size_t n_indices = 0;

	add_grid(PART_FLOOR, floor_surface, 0, 0, 64, 160, 7, 28);
	add_grid(PART_STONE, vault_surface, 0, 0, 48, 160, 6, 14);
	for (int side = -1; side <= 1; side += 2) {
		add_grid(PART_STONE, wall_surface, (float)side, 0, 160, 24, 14, 2);
		add_grid(PART_STONE, end_surface, (float)side, 0, 32, 24, 4, 3);
		for (int i = 0; i < COLUMNS_PER_ROW; i++) {
			float z = column_pitch * ((float)i - (COLUMNS_PER_ROW - 1) / 2.0f);

			add_grid(PART_MARBLE, column_surface, column_x * (float)side, z, 48, 60, 2, 4);
			if (i > 0)
				add_grid(PART_STONE, arch_surface, column_x * (float)side, z - column_pitch / 2, 24, 24, 4, 1);
		}
	}
	add_rosette();
	add_statue();

	for (int i = 0; i < N_PARTS; i++)
		n_indices += parts[i].n_indices;
	if (n_indices != 3 * N_TRIANGLES) {
		fprintf(stderr, "hall: %zu triangles instead of %d\n", n_indices / 3, N_TRIANGLES);
		exit(1);
	}
}
