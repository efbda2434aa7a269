#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "verbs/render/bench/bench.h"

/* One model of the scene: turned about y, scaled to a height, set down on the floor at x z. */
struct place {
	const char *file;
	float height, turn_deg, x, z;
};

static const struct place places[] = {
	{ "stanford-bunny.obj", 1.6f, 0, -1.7f, 0.0f },   { "stanford-bunny.obj", 1.8f, 40, 0.0f, -0.6f },
	{ "stanford-bunny.obj", 1.6f, -70, 1.7f, 0.2f },  { "cow.obj", 0.9f, 20, -0.9f, 1.3f },
	{ "cow.obj", 1.2f, 160, 2.6f, -2.2f },            { "spot.obj", 0.9f, 200, 0.9f, 1.3f },
	{ "spot.obj", 1.2f, 150, -2.6f, -2.2f },          { "teapot.obj", 0.5f, 30, 0.0f, 1.9f },
	{ "teapot.obj", 0.5f, 120, -2.2f, 1.6f },         { "teapot.obj", 0.5f, -20, 2.2f, 1.6f },
};
#define N_PLACES (sizeof(places) / sizeof(places[0]))

/* The camera's position: above the floor, looking down at it. */
#define EYE_HEIGHT 2.0f
#define EYE_DISTANCE 5.6f
#define EYE_PITCH_DEG 14.0f

struct growing {
	struct bench_mesh *mesh;
	size_t vertex_room, triangle_room;
};

static int add_vertex(struct growing *g, float x, float y, float z)
{
	struct bench_mesh *m = g->mesh;

	if (MEMORY_GROW(m->position, g->vertex_room, m->n_vertices + (size_t)1))
		return ERR_SYSTEM;
	memcpy(m->position[m->n_vertices++], (float[4]){ x, y, z, 1 }, sizeof(*m->position));
	return 0;
}

static int add_triangle(struct growing *g, uint32_t a, uint32_t b, uint32_t c)
{
	struct bench_mesh *m = g->mesh;

	if (MEMORY_GROW(m->index, g->triangle_room, m->n_triangles + (size_t)1))
		return ERR_SYSTEM;
	memcpy(m->index[m->n_triangles++], (uint32_t[3]){ a, b, c }, sizeof(*m->index));
	return 0;
}

/* One line of an OBJ file: a vertex, or a polygon as a fan. Everything else is of no interest here. */
static int add_obj_line(struct growing *g, char *line, uint32_t base)
{
	uint32_t corner[3];
	float x, y, z;
	int n = 0, err = 0;

	if (sscanf(line, "v %f %f %f", &x, &y, &z) == 3)
		return add_vertex(g, x, y, z);
	if (line[0] != 'f' || line[1] != ' ')
		return 0;
	for (char *word = strtok(line + 2, " \t\r\n"); word && !err; word = strtok(NULL, " \t\r\n")) {
		long index = strtol(word, NULL, 10);

		if (index < 1 || (unsigned long)index > g->mesh->n_vertices - base)
			return ERR_INPUT;
		corner[n < 2 ? n : 2] = base + (uint32_t)index - 1;
		if (++n >= 3) {
			err = add_triangle(g, corner[0], corner[1], corner[2]);
			corner[1] = corner[2];
		}
	}
	return err;
}

/* Append a model as it is in its file. 0, ERR_INPUT (not reported) or ERR_SYSTEM */
static int add_obj(struct growing *g, const char *folder, const char *name)
{
	const uint32_t base = g->mesh->n_vertices, before = g->mesh->n_triangles;
	char path[1024], line[512];
	FILE *file;
	int err = 0;

	if (!folder || snprintf(path, sizeof(path), "%s/%s", folder, name) >= (int)sizeof(path))
		return ERR_INPUT;
	file = fopen(path, "r");
	if (!file)
		return ERR_INPUT;
	while (!err && fgets(line, sizeof(line), file))
		err = add_obj_line(g, line, base);
	if (!err && ferror(file))
		err = err_report(ERR_SYSTEM, path, "cannot be read: %s", strerror(errno));
	fclose(file);
	return !err && g->mesh->n_triangles == before ? ERR_INPUT : err;
}

/* A sphere with bumps, of 2 * n * n triangles. */
static int add_bumpy_sphere(struct growing *g, uint32_t n)
{
	const uint32_t base = g->mesh->n_vertices;
	int err = 0;

	for (uint32_t i = 0; i <= n && !err; i++)
		for (uint32_t j = 0; j <= n && !err; j++) {
			const float a = 3.14159265f * (float)i / (float)n, b = 6.2831853f * (float)(j % n) / (float)n;
			const float r = 1 + 0.08f * sinf(9 * a) * sinf(8 * b) + 0.02f * sinf(40 * a) * sinf(32 * b);

			err = add_vertex(g, r * sinf(a) * cosf(b), r * cosf(a), r * sinf(a) * sinf(b));
		}
	for (uint32_t i = 0; i < n && !err; i++)
		for (uint32_t j = 0; j < n && !err; j++) {
			const uint32_t v = base + i * (n + 1) + j;

			err = add_triangle(g, v, v + 1, v + n + 1);
			if (!err)
				err = add_triangle(g, v + 1, v + n + 2, v + n + 1);
		}
	return err;
}

/* Turn, scale and set down the vertices from `first` on. */
static void put_down(struct bench_mesh *mesh, uint32_t first, const struct place *place)
{
	const float turn = place->turn_deg * 3.14159265f / 180, c = cosf(turn), s = sinf(turn);
	float lo[3] = { 1e30f, 1e30f, 1e30f }, hi[3] = { -1e30f, -1e30f, -1e30f }, scale;

	for (uint32_t i = first; i < mesh->n_vertices; i++)
		for (int a = 0; a < 3; a++) {
			lo[a] = fminf(lo[a], mesh->position[i][a]);
			hi[a] = fmaxf(hi[a], mesh->position[i][a]);
		}
	scale = place->height / (hi[1] - lo[1]);
	for (uint32_t i = first; i < mesh->n_vertices; i++) {
		float *p = mesh->position[i];
		const float x = (p[0] - 0.5f * (lo[0] + hi[0])) * scale, z = (p[2] - 0.5f * (lo[2] + hi[2])) * scale;

		p[0] = c * x + s * z + place->x;
		p[1] = (p[1] - lo[1]) * scale;
		p[2] = c * z - s * x + place->z;
	}
}

static int add_floor(struct growing *g)
{
	const uint32_t base = g->mesh->n_vertices;
	const float size = 6;
	int err = add_vertex(g, -size, 0, -size);

	if (!err)
		err = add_vertex(g, size, 0, -size);
	if (!err)
		err = add_vertex(g, size, 0, size);
	if (!err)
		err = add_vertex(g, -size, 0, size);
	if (!err)
		err = add_triangle(g, base, base + 2, base + 1);
	return err ? err : add_triangle(g, base, base + 3, base + 2);
}

static void move_to_eye_space(struct bench_mesh *mesh)
{
	const float pitch = EYE_PITCH_DEG * 3.14159265f / 180, c = cosf(pitch), s = sinf(pitch);

	for (uint32_t i = 0; i < mesh->n_vertices; i++) {
		float *p = mesh->position[i];
		const float y = p[1] - EYE_HEIGHT, z = p[2] - EYE_DISTANCE;

		p[1] = c * y - s * z;
		p[2] = s * y + c * z;
	}
}

static int add_models(struct growing *g, const char *models)
{
	int err = 0;

	for (size_t i = 0; i < N_PLACES && !err; i++) {
		const uint32_t first = g->mesh->n_vertices;

		err = add_obj(g, models, places[i].file);
		if (!err)
			put_down(g->mesh, first, &places[i]);
	}
	return err;
}

static int add_stand_ins(struct growing *g)
{
	int err = 0;

	for (size_t i = 0; i < N_PLACES && !err; i++) {
		const uint32_t first = g->mesh->n_vertices;

		err = add_bumpy_sphere(g, i < 3 ? 186 : 55);
		if (!err)
			put_down(g->mesh, first, &places[i]);
	}
	return err;
}

int bench_mesh_create(const char *models, struct bench_mesh *out)
{
	struct growing g = { out, 0, 0 };
	int err;

	memset(out, 0, sizeof(*out));
	snprintf(out->source, sizeof(out->source), "bunny, cow, spot, teapot");
	err = add_models(&g, models);
	if (err == ERR_INPUT) {
		err_warn(models, "the models are not there: bumpy spheres stand in for them");
		bench_mesh_free(out);
		g = (struct growing){ out, 0, 0 };
		snprintf(out->source, sizeof(out->source), "stand-in: bumpy spheres");
		err = add_stand_ins(&g);
	}
	if (!err)
		err = add_floor(&g);
	if (!err)
		move_to_eye_space(out);
	else
		bench_mesh_free(out);
	return err;
}

void bench_mesh_free(struct bench_mesh *mesh)
{
	free(mesh->position);
	free(mesh->index);
	memset(mesh, 0, sizeof(*mesh));
}
