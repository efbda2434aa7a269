/* Runs the steps of a repair, and builds the resulting mesh. */
#include "scene/repair/repair.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "scene/repair/doubles.h"
#include "scene/repair/junctions.h"
#include "scene/repair/merge.h"
#include "scene/repair/shape.h"
#include "scene/repair/turn.h"

/* Mending is repeated, as the new edges may meet further corners. */
enum { ROUNDS = 4 };

/* --- The state of the mesh --------------------------------------------------------------------------------------- */

static double volume_of(const struct shape *s)
{
	const double *middle = s->points[0];
	double sum = 0;

	for (size_t f = 0; f < s->n_faces; f++) {
		double normal[3];

		if (s->faces[f].p[0] == SCENE_NONE)
			continue;
		shape_normal(s, &s->faces[f], normal);
		for (int k = 0; k < 3; k++)
			sum += normal[k] * (s->points[s->faces[f].p[0]][k] - middle[k]) / 6;
	}
	return sum;
}

static int tell(const struct shape *s)
{
	struct repair_found *found = s->found;
	struct shape_edge *edges;
	double longest = -1;
	size_t n;
	int err = shape_list_edges(s, &edges, &n), balance;

	for (size_t first = 0, end; first < n && !err; first = end) {
		const double *a = s->points[edges[first].a], *b = s->points[edges[first].b];
		const double square = (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]);

		end = shape_run_end(s, edges, n, first, &balance);
		found->twisted += balance != 0 && balance % 2 == 0;
		found->leaks += balance % 2 != 0;
		if (balance % 2 == 0 || square <= longest)
			continue;
		longest = square;
		for (int k = 0; k < 3; k++)
			found->leak_at[k] = (float)(0.5 * (a[k] + b[k]));
	}
	found->closed = n > 0 && !found->leaks && !found->twisted;
	found->volume = found->closed ? volume_of(s) : 0;
	free(edges);
	return err;
}

/* --- The resulting mesh ------------------------------------------------------------------------------------------ */

static void fill_positions(const struct shape *s, float *out)
{
	const size_t n = s->mesh->vertex_count;

	memcpy(out, s->mesh->position, 4 * n * sizeof(*out));
	for (size_t v = 0; v < n + s->n_made; v++) {
		const uint32_t point = v < n ? s->point_of[v] : s->made[v - n].point;

		out[4 * v + 3] = 1;
		for (size_t k = 0; k < 3 && point != SCENE_NONE; k++)
			if ((double)out[4 * v + k] != s->points[point][k] || v >= n)
				out[4 * v + k] = (float)s->points[point][k];
	}
}

static void fill_attribute(const struct shape *s, const struct shape_attribute *a, float *out)
{
	const size_t n = s->mesh->vertex_count;

	memcpy(out, *a->array, a->each * n * sizeof(*out));
	for (size_t i = 0; i < s->n_made; i++) {
		const struct shape_made *m = &s->made[i];
		const float *from = out + a->each * m->a, *to = out + a->each * m->b;

		if (a->is_color && s->wants->flat)
			from = to = out + a->each * m->like;
		for (size_t k = 0; k < a->each; k++)
			out[a->each * (n + i) + k] = from[k] + (to[k] - from[k]) * m->at;
	}
}

static int build(const struct shape *s, struct scene_mesh **out)
{
	const size_t vertices = s->mesh->vertex_count + s->n_made;
	const uint32_t wants = (uint32_t)(s->wants->turn | s->wants->clockwise << 1 | s->wants->merge << 2 |
	                                  s->wants->flat << 3);
	struct scene_mesh copy = *s->mesh, *made;
	struct shape_attribute list[SHAPE_MOST_ATTRIBUTES];
	const size_t n = shape_list_attributes(&copy, list);
	size_t words = 4 * vertices + 4 * s->n_faces;
	float *at;
	uint32_t *index, bits;

	for (size_t i = 0; i < n; i++)
		words += list[i].each * vertices;
	made = malloc(sizeof(*made) + words * sizeof(float));
	if (!made)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	at = (float *)(made + 1);
	fill_positions(s, at);
	copy.position = at;
	at += 4 * vertices;
	for (size_t i = 0; i < n; i++) {
		fill_attribute(s, &list[i], at);
		*list[i].array = at;
		at += list[i].each * vertices;
	}
	index = (uint32_t *)at;
	copy.index = index;
	copy.primitive_draw = s->mesh->primitive_draw ? index + 3 * s->n_faces : NULL;
	for (size_t f = 0; f < s->n_faces; f++) {
		memcpy(index + 3 * f, s->faces[f].v, 3 * sizeof(*index));
		if (copy.primitive_draw)
			index[3 * s->n_faces + f] = s->mesh->primitive_draw[s->faces[f].from];
	}
	copy.edge_flags = NULL; /* these belong to polygons drawn as lines */
	copy.crease = NULL;
	copy.vertex_count = (uint32_t)vertices;
	copy.primitive_count = (uint32_t)s->n_faces;
	memcpy(&bits, &s->wants->weld, sizeof(bits));
	/* a hash of its own for all caches, and another after merging */
	copy.hash[0] = (copy.hash[0] ^ wants) * 0x9E3779B97F4A7C15u;
	copy.hash[1] = (copy.hash[1] ^ bits) * 0x9E3779B97F4A7C15u;
	*made = copy;
	*out = made;
	return 0;
}

/* --- All steps --------------------------------------------------------------------------------------------------- */

static int mend(struct shape *s)
{
	uint32_t junctions = 1;
	int err = 0;

	for (int round = 0; round < ROUNDS && junctions && !err; round++) {
		err = junctions_mend(s, &junctions);
		s->found->junctions += junctions;
		if (!err && junctions)
			err = doubles_drop(s);
	}
	return err ? err : doubles_drop_backs(s);
}

static int is_whole(const struct scene_mesh *mesh)
{
	if (mesh->kind != SCENE_TRIANGLES || !mesh->primitive_count)
		return 0;
	for (size_t v = 0; v < mesh->vertex_count; v++)
		if (mesh->position[4 * v + 3] != 1)
			return 0;
	return 1;
}

/* *open: 1 if some edge has not as many triangles one way as the other. */
static int is_open(const struct shape *s, int *open)
{
	struct shape_edge *edges;
	size_t n;
	int err = shape_list_edges(s, &edges, &n), balance = 0;

	for (size_t first = 0; first < n && !err && !balance;)
		first = shape_run_end(s, edges, n, first, &balance);
	*open = balance != 0;
	free(edges);
	return err;
}

/* Run all steps but merging. */
static int close_cracks(struct shape *s)
{
	int open = 0, err = doubles_drop(s);

	if (!err)
		err = is_open(s, &open);
	if (!err && open)
		err = doubles_drop_narrow(s);
	if (!err && open)
		err = mend(s);
	return err ? err : turn_outwards(s, s->wants->turn);
}

static int changes(const struct repair_found *found)
{
	return found->welded || found->junctions || found->dropped || found->turned || found->merged;
}

/* Merge after cracks are closed, in a second mesh, as merging reads the attributes of new vertices. mesh: repaired or
 * not; out: as for repair_mesh */
static int merge(const struct scene_mesh *mesh, const struct repair_wants *wants, struct repair_found *found,
                 struct scene_mesh **out)
{
	struct repair_found again = { .welded = 0 };
	struct shape s;
	int err = shape_init(&s, mesh, wants, &again);

	if (!err)
		err = merge_flat(&s, &found->merged);
	if (!err && found->merged)
		err = build(&s, out);
	shape_free(&s);
	return err;
}

int repair_mesh(const struct scene_mesh *mesh, const struct repair_wants *wants, struct repair_found *found,
                struct scene_mesh **out)
{
	struct scene_mesh *merged = NULL;
	struct shape s;
	int err;

	*out = NULL;
	*found = (struct repair_found){ .welded = 0 };
	if (!is_whole(mesh))
		return 0;
	err = shape_init(&s, mesh, wants, found);
	if (!err)
		err = close_cracks(&s);
	if (!err)
		err = tell(&s);
	if (!err && changes(found))
		err = build(&s, out);
	shape_free(&s);
	if (!err && wants->merge)
		err = merge(*out ? *out : mesh, wants, found, &merged);
	if (err || merged) {
		free(*out);
		*out = merged;
	}
	return err;
}
