/* Drops degenerate triangles, and duplicates with the same or the opposite winding. */
#include "scene/repair/doubles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "scene/repair/shape.h"

/* Three places in ascending order. */
struct triple {
	uint32_t p[3];
	uint32_t face;
	int odd; /* 1: the triangle winds the other way */
};

static int compare_places(const struct triple *a, const struct triple *b)
{
	for (int k = 0; k < 3; k++)
		if (a->p[k] != b->p[k])
			return a->p[k] < b->p[k] ? -1 : 1;
	return 0;
}

static int compare_triples(const void *a, const void *b)
{
	const struct triple *one = a, *other = b;
	const int places = compare_places(one, other);

	if (places || one->odd != other->odd)
		return places ? places : one->odd - other->odd;
	return one->face < other->face ? -1 : one->face > other->face;
}

static struct triple triple_of(const struct shape_face *f, uint32_t number)
{
	struct triple t = { .p = { f->p[0], f->p[1], f->p[2] }, .face = number };

	for (int k = 0; k < 3; k++) {
		const int i = k % 2;

		if (t.p[i] > t.p[i + 1]) {
			const uint32_t kept = t.p[i];

			t.p[i] = t.p[i + 1];
			t.p[i + 1] = kept;
			t.odd = !t.odd;
		}
	}
	return t;
}

static int is_none(const struct shape_face *f)
{
	return f->p[0] != SCENE_NONE && (f->p[0] == f->p[1] || f->p[1] == f->p[2] || f->p[2] == f->p[0]);
}

/* Sorted places of all triangles. marks: [n_faces], receives 1 for degenerate triangles. @return NULL: out of memory
 * (reported) */
static struct triple *list_triples(const struct shape *s, uint8_t **marks, size_t *n)
{
	struct triple *list = malloc((s->n_faces + 1) * sizeof(*list));

	*marks = calloc(s->n_faces + 1, 1);
	*n = 0;
	if (!list || !*marks) {
		free(list);
		free(*marks);
		*marks = NULL;
		err_report(ERR_SYSTEM, NULL, "out of memory");
		return NULL;
	}
	for (size_t f = 0; f < s->n_faces; f++) {
		(*marks)[f] = (uint8_t)is_none(&s->faces[f]);
		if (!(*marks)[f] && s->faces[f].p[0] != SCENE_NONE)
			list[(*n)++] = triple_of(&s->faces[f], (uint32_t)f);
	}
	qsort(list, *n, sizeof(*list), compare_triples);
	return list;
}

int doubles_drop(struct shape *s)
{
	uint8_t *marks;
	size_t n;
	struct triple *list = list_triples(s, &marks, &n);

	for (size_t i = 1; list && i < n; i++)
		if (compare_places(&list[i - 1], &list[i]) == 0 && list[i - 1].odd == list[i].odd)
			marks[list[i].face] = 1;
	if (list)
		shape_drop(s, marks);
	free(list);
	free(marks);
	return list ? 0 : ERR_SYSTEM;
}

static double longest_edge(const struct shape *s, const struct shape_face *f)
{
	double most = 0;

	for (int k = 0; k < 3; k++) {
		const double *a = s->points[f->p[k]], *b = s->points[f->p[(k + 1) % 3]];
		const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];

		most = fmax(most, sqrt(x * x + y * y + z * z));
	}
	return most;
}

int doubles_drop_narrow(struct shape *s)
{
	uint8_t *marks = calloc(s->n_faces + 1, 1);
	double normal[3];

	if (!marks)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t f = 0; f < s->n_faces; f++)
		marks[f] = s->faces[f].p[0] != SCENE_NONE &&
		           shape_normal(s, &s->faces[f], normal) <= s->tolerance * longest_edge(s, &s->faces[f]);
	shape_drop(s, marks);
	free(marks);
	return 0;
}

/* --- Back to back ------------------------------------------------------------------------------------------------ */

/* For the edge of a corner: its number of triangles, and how many run along as this one less how many run against
 * it. */
struct around {
	int all, along;
};

static int count_around(const struct shape *s, struct around *around)
{
	struct shape_edge *edges;
	size_t n;
	int err = shape_list_edges(s, &edges, &n), balance;

	for (size_t first = 0, end; first < n && !err; first = end) {
		end = shape_run_end(s, edges, n, first, &balance);
		for (size_t i = first; i < end; i++) {
			const int sense = s->faces[edges[i].use / 3].p[edges[i].use % 3] == edges[i].a ? 1 : -1;

			around[edges[i].use] = (struct around){ (int)(end - first), balance * sense };
		}
	}
	free(edges);
	return err;
}

/*
 * If two triangles are back to back and an edge of theirs has an odd number of triangles, mark the one that its
 * neighbours run along with.
 * @return number of marks
 */
static uint32_t mark_backs(const struct triple *list, size_t n, const struct around *around, uint8_t *marks)
{
	uint32_t marked = 0;

	for (size_t i = 1; i < n; i++) {
		int odd = 0, along = 0;

		if (compare_places(&list[i - 1], &list[i]) != 0)
			continue;
		for (uint32_t k = 0; k < 3; k++) {
			const struct around *edge = &around[3 * list[i].face + k];

			odd += edge->all % 2;
			along += edge->all % 2 ? edge->along : 0;
		}
		if (odd) {
			marks[along > 0 || (along == 0 && list[i].face > list[i - 1].face) ? list[i].face : list[i - 1].face] = 1;
			marked++;
		}
	}
	return marked;
}

int doubles_drop_backs(struct shape *s)
{
	uint32_t marked = 1;
	int err = 0;

	while (marked && !err) { /* peel stacks of triangles from the outside */
		uint8_t *marks;
		size_t n;
		struct triple *list = list_triples(s, &marks, &n);
		struct around *around = calloc(3 * s->n_faces + 1, sizeof(*around));

		err = list && around ? count_around(s, around) : err_report(ERR_SYSTEM, NULL, "out of memory");
		marked = err ? 0 : mark_backs(list, n, around, marks);
		if (marked)
			shape_drop(s, marks);
		free(around);
		free(list);
		free(marks);
	}
	return err;
}

int doubles_find_backs(const struct shape *s, uint8_t **marks)
{
	size_t n;
	struct triple *list = list_triples(s, marks, &n);

	for (size_t i = 1; i < n; i++)
		(*marks)[list[i].face] |= compare_places(&list[i - 1], &list[i]) == 0;
	free(list);
	return list ? 0 : ERR_SYSTEM;
}
