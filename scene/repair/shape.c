/* The mesh under repair: its triangles, places and edges. */
#include "scene/repair/shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "scene/repair/weld.h"

int shape_init(struct shape *s, const struct scene_mesh *mesh, const struct repair_wants *wants,
               struct repair_found *found)
{
	*s = (struct shape){ .mesh = mesh, .wants = wants, .found = found };
	s->faces = malloc((mesh->primitive_count + (size_t)1) * sizeof(*s->faces));
	if (!s->faces)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	s->n_faces = s->room_faces = mesh->primitive_count;
	if (weld_points(s))
		return ERR_SYSTEM;
	for (uint32_t f = 0; f < mesh->primitive_count; f++) {
		struct shape_face *face = &s->faces[f];
		int loose = 0;

		face->from = f;
		for (int k = 0; k < 3; k++) {
			face->v[k] = mesh->index[3 * (size_t)f + (size_t)k];
			face->p[k] = s->point_of[face->v[k]];
			loose |= face->p[k] == SCENE_NONE;
		}
		for (int k = 0; k < 3 && loose; k++)
			face->p[k] = SCENE_NONE;
	}
	return 0;
}

void shape_free(struct shape *s)
{
	free(s->points);
	free(s->point_of);
	free(s->faces);
	free(s->made);
}

static int compare_edges(const void *a, const void *b)
{
	const struct shape_edge *one = a, *other = b;

	if (one->a != other->a)
		return one->a < other->a ? -1 : 1;
	if (one->b != other->b)
		return one->b < other->b ? -1 : 1;
	return one->use < other->use ? -1 : one->use > other->use;
}

int shape_list_edges(const struct shape *s, struct shape_edge **edges, size_t *n)
{
	struct shape_edge *list = malloc((3 * s->n_faces + 1) * sizeof(*list));

	*n = 0;
	*edges = list;
	if (!list)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t f = 0; f < s->n_faces; f++)
		for (uint32_t k = 0; k < 3 && s->faces[f].p[0] != SCENE_NONE; k++) {
			const uint32_t from = s->faces[f].p[k], to = s->faces[f].p[(k + 1) % 3];

			list[(*n)++] = (struct shape_edge){ from < to ? from : to, from < to ? to : from, (uint32_t)(3 * f) + k };
		}
	qsort(list, *n, sizeof(*list), compare_edges);
	return 0;
}

size_t shape_run_end(const struct shape *s, const struct shape_edge *edges, size_t n, size_t first, int *balance)
{
	size_t end = first;

	*balance = 0;
	for (; end < n && edges[end].a == edges[first].a && edges[end].b == edges[first].b; end++)
		*balance += s->faces[edges[end].use / 3].p[edges[end].use % 3] == edges[end].a ? 1 : -1;
	return end;
}

void shape_drop(struct shape *s, const uint8_t *marks)
{
	size_t n = 0;

	for (size_t f = 0; f < s->n_faces; f++)
		if (!marks[f])
			s->faces[n++] = s->faces[f];
	s->found->dropped += (uint32_t)(s->n_faces - n);
	s->n_faces = n;
}

double shape_normal(const struct shape *s, const struct shape_face *face, double out[3])
{
	const double *a = s->points[face->p[0]], *b = s->points[face->p[1]], *c = s->points[face->p[2]];

	for (int k = 0; k < 3; k++) {
		const int i = (k + 1) % 3, j = (k + 2) % 3;

		out[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
	}
	return sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
}

size_t shape_list_attributes(struct scene_mesh *mesh, struct shape_attribute list[SHAPE_MOST_ATTRIBUTES])
{
	const struct shape_attribute all[] = {
		{ &mesh->normal, 3, 1 }, { &mesh->color, 4, 1 }, { &mesh->secondary, 4, 1 }, { &mesh->fog_coord, 1, 0 },
		{ (const float **)&mesh->face, 2 * sizeof(struct scene_face) / sizeof(float), 1 },
	};
	size_t n = 0;

	for (size_t i = 0; i < sizeof(all) / sizeof(*all); i++)
		if (*all[i].array)
			list[n++] = all[i];
	for (int i = 0; i < SCENE_MAX_UNITS; i++)
		if (mesh->texcoord[i])
			list[n++] = (struct shape_attribute){ &mesh->texcoord[i], 4, 0 };
	for (int i = 0; i < SCENE_MAX_GENERICS; i++)
		if (mesh->generics[i])
			list[n++] = (struct shape_attribute){ &mesh->generics[i], 4, 0 };
	return n;
}
