#include "verbs/query/soup.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "tracer/frame/prepare/prepare.h"

/* The mesh of an instance if rays of a space see it, else NULL. */
static const struct scene_mesh *seen_mesh(const struct scene *scene, const struct prepared *p, uint32_t space,
                                          uint32_t i)
{
	const struct scene_instance *instance = &scene->instances[p->instances[i].scene_instance];

	if (!(p->instances[i].flags & INSTANCE_SECONDARY) || p->depths[p->instances[i].scene_instance] ||
	    p->shapes[i] != PREPARED_FILLED || scene->views[instance->view].space != space)
		return NULL;
	return scene->meshes[instance->mesh];
}

/* The space with the most triangles; the first of equal ones. */
static uint32_t largest_space(const struct scene *scene, const struct prepared *p)
{
	uint32_t best = SCENE_NONE;
	uint64_t most = 0;

	for (uint32_t v = 0; v < scene->n_views; v++) {
		const uint32_t space = scene->views[v].space;
		uint64_t n = 0;

		for (uint32_t i = 0; i < p->n_instances; i++) {
			const struct scene_mesh *mesh = seen_mesh(scene, p, space, i);

			n += mesh ? mesh->primitive_count : 0;
		}
		if (n > most) {
			most = n;
			best = space;
		}
	}
	return best;
}

/* @return 0: the vertex has no position in eye space */
static int to_eye(const float *m, const float *p, float out[4])
{
	float e[4];

	for (int row = 0; row < 4; row++)
		e[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row] * p[3];
	for (int a = 0; a < 3; a++)
		out[a] = e[a] / e[3];
	out[3] = 1;
	return e[3] > 0 && isfinite(out[0]) && isfinite(out[1]) && isfinite(out[2]);
}

static int has_place(const float p[4])
{
	return p[3] == 1;
}

/* Append one instance. There is room for it. */
static void add_instance(const struct scene_instance *instance, const struct scene_mesh *mesh, struct query_soup *out)
{
	const uint32_t first = out->n_vertices;

	for (uint32_t i = 0; i < mesh->vertex_count; i++)
		if (!to_eye(instance->modelview, mesh->position + 4 * (size_t)i, out->position[first + i]))
			memset(out->position[first + i], 0, sizeof(*out->position));
	out->n_vertices += mesh->vertex_count;
	for (uint32_t i = 0; i < mesh->primitive_count; i++) {
		const uint32_t *from = mesh->index + 3 * (size_t)i;
		uint32_t *to = out->index[out->n_triangles];
		int whole = 1;

		for (int k = 0; k < 3; k++) {
			to[k] = first + from[k];
			whole &= has_place(out->position[to[k]]);
		}
		if (!whole)
			continue;
		out->sources[out->n_triangles].draw = instance->draw + (mesh->primitive_draw ? mesh->primitive_draw[i] : 0);
		out->sources[out->n_triangles++].primitive = i;
	}
}

static int make_room(size_t n_vertices, size_t n_triangles, int sources, struct query_soup *out)
{
	if (n_vertices >= SCENE_NONE || n_triangles >= SCENE_NONE / 3)
		return err_report(ERR_SYSTEM, NULL, "%zu triangles are too many for one scene", n_triangles);
	if (memory_resize(&out->position, n_vertices, sizeof(*out->position)) ||
	    memory_resize(&out->index, n_triangles, sizeof(*out->index)) ||
	    (sources && memory_resize(&out->sources, n_triangles, sizeof(*out->sources))))
		return ERR_SYSTEM;
	return 0;
}

int query_soup_of_frame(const struct scene *scene, struct query_soup *out)
{
	static const float nowhere[2] = { 0, 0 };
	struct prepared p = { NULL };
	size_t n_vertices = 0, n_triangles = 0;
	uint32_t space;
	int err = prepare_frame(scene, nowhere, &p);

	*out = (struct query_soup){ NULL };
	if (err)
		return err;
	space = largest_space(scene, &p);
	for (uint32_t i = 0; i < p.n_instances; i++) {
		const struct scene_mesh *mesh = seen_mesh(scene, &p, space, i);

		if (mesh) {
			n_vertices += mesh->vertex_count;
			n_triangles += mesh->primitive_count;
		}
	}
	err = make_room(n_vertices, n_triangles, 1, out);
	for (uint32_t i = 0; i < p.n_instances && !err; i++) {
		const struct scene_mesh *mesh = seen_mesh(scene, &p, space, i);

		if (mesh)
			add_instance(&scene->instances[p.instances[i].scene_instance], mesh, out);
	}
	prepared_free(&p);
	if (err)
		query_soup_free(out);
	return err;
}

int query_soup_of_triangles(const float (*position)[3], size_t n_vertices, const uint32_t (*index)[3],
                            size_t n_triangles, const char *where, struct query_soup *out)
{
	int err;

	*out = (struct query_soup){ NULL };
	err = make_room(n_vertices, n_triangles, 0, out);
	for (size_t i = 0; i < n_vertices && !err; i++) {
		memcpy(out->position[i], position[i], sizeof(*position));
		out->position[i][3] = 1;
		if (!isfinite(position[i][0]) || !isfinite(position[i][1]) || !isfinite(position[i][2]))
			err = err_report(ERR_USAGE, where, "vertex %zu is not finite", i);
	}
	for (size_t i = 0; i < n_triangles && !err; i++) {
		memcpy(out->index[i], index[i], sizeof(*index));
		for (int k = 0; k < 3 && !err; k++)
			if (index[i][k] >= n_vertices)
				err = err_report(ERR_USAGE, where, "triangle %zu has vertex %u of %zu", i, index[i][k], n_vertices);
	}
	out->n_vertices = (uint32_t)n_vertices;
	out->n_triangles = (uint32_t)n_triangles;
	if (err)
		query_soup_free(out);
	return err;
}

void query_soup_free(struct query_soup *soup)
{
	free(soup->position);
	free(soup->index);
	free(soup->sources);
	*soup = (struct query_soup){ NULL };
}
