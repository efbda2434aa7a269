/* Finds corners that lie on open edges, by a tree of boxes, and cuts the triangles there. */
#include "scene/repair/junctions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "scene/repair/doubles.h"
#include "scene/repair/shape.h"

/* --- Tree of open edges' places: halves of the range [first, end) of a sorted list, down to LEAF places
 * ------------ */

enum { LEAF = 4 };

struct place {
	uint64_t order; /* interleaved bits of x, y and z, so that neighbours in order are mostly neighbours in space */
	uint32_t point;
};

struct box {
	double low[3], high[3];
};

struct tree {
	const struct shape *s;
	struct place *places;
	size_t n;
	struct box *boxes; /* box of node i; its halves are 2i + 1 and 2i + 2 */
};

static int compare_places(const void *a, const void *b)
{
	const struct place *one = a, *other = b;

	if (one->order != other->order)
		return one->order < other->order ? -1 : 1;
	return one->point < other->point ? -1 : one->point > other->point;
}

static uint64_t order_of(const double at[3], const struct box *all)
{
	uint64_t order = 0;
	uint32_t step[3];

	for (int k = 0; k < 3; k++) {
		const double width = all->high[k] - all->low[k];

		step[k] = width > 0 ? (uint32_t)((at[k] - all->low[k]) / width * 1048575) : 0;
	}
	for (int bit = 19; bit >= 0; bit--)
		for (int k = 0; k < 3; k++)
			order = order << 1 | (step[k] >> bit & 1);
	return order;
}

static void grow(struct box *box, const double at[3])
{
	for (int k = 0; k < 3; k++) {
		box->low[k] = fmin(box->low[k], at[k]);
		box->high[k] = fmax(box->high[k], at[k]);
	}
}

static const struct box nowhere = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

static void find_boxes(struct tree *t, size_t node, size_t first, size_t end)
{
	struct box box = nowhere;

	for (size_t i = first; i < end; i++)
		grow(&box, t->s->points[t->places[i].point]);
	t->boxes[node] = box;
	if (end - first > LEAF) {
		find_boxes(t, 2 * node + 1, first, first + (end - first) / 2);
		find_boxes(t, 2 * node + 2, first + (end - first) / 2, end);
	}
}

/* marks: [n_points], 1 for each place to put into the tree */
static int plant(struct tree *t, const struct shape *s, const uint8_t *marks)
{
	struct box all = nowhere;
	size_t nodes = 1;

	*t = (struct tree){ .s = s };
	for (uint32_t p = 0; p < s->n_points; p++)
		t->n += marks[p];
	while (nodes < 2 * t->n)
		nodes *= 2;
	t->places = malloc((t->n + 1) * sizeof(*t->places));
	t->boxes = malloc(2 * nodes * sizeof(*t->boxes));
	if (!t->places || !t->boxes)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t p = 0; p < s->n_points; p++)
		if (marks[p])
			grow(&all, s->points[p]);
	t->n = 0;
	for (uint32_t p = 0; p < s->n_points; p++)
		if (marks[p])
			t->places[t->n++] = (struct place){ order_of(s->points[p], &all), p };
	qsort(t->places, t->n, sizeof(*t->places), compare_places);
	find_boxes(t, 0, 0, t->n);
	return 0;
}

static void fell(struct tree *t)
{
	free(t->places);
	free(t->boxes);
}

/* --- Places on an edge ------------------------------------------------------------------------------------------- */

struct on_edge {
	double along; /* distance from a, in units of length */
	uint32_t point;
};

struct asking {
	const struct tree *tree;
	uint32_t a, b;
	double from[3], way[3], length;
	struct on_edge *list;
	size_t n, room;
};

/* 1 if the edge comes within the tolerance of a box, or slightly beyond. */
static int is_near(const struct asking *q, const struct box *box)
{
	double near = 0, far = q->length;

	for (int k = 0; k < 3; k++) {
		const double low = box->low[k] - q->tree->s->tolerance - q->from[k],
			     high = box->high[k] + q->tree->s->tolerance - q->from[k];

		if (fabs(q->way[k]) < 1e-12) {
			if (low > 1e-12 * q->length || high < -1e-12 * q->length)
				return 0;
			continue;
		}
		near = fmax(near, fmin(low / q->way[k], high / q->way[k]));
		far = fmin(far, fmax(low / q->way[k], high / q->way[k]));
	}
	return near <= far;
}

static int ask_point(struct asking *q, uint32_t point)
{
	double to[3], along = 0, square = 0;

	for (int k = 0; k < 3; k++) {
		to[k] = q->tree->s->points[point][k] - q->from[k];
		along += to[k] * q->way[k];
	}
	for (int k = 0; k < 3; k++)
		square += (to[k] - along * q->way[k]) * (to[k] - along * q->way[k]);
	if (point == q->a || point == q->b || !(along > 0 && along < q->length) || sqrt(square) > q->tree->s->tolerance)
		return 0;
	if (MEMORY_GROW(q->list, q->room, q->n + 1))
		return ERR_SYSTEM;
	q->list[q->n++] = (struct on_edge){ along, point };
	return 0;
}

static int ask(struct asking *q, size_t node, size_t first, size_t end)
{
	const size_t half = first + (end - first) / 2;
	int err = 0;

	if (!is_near(q, &q->tree->boxes[node]))
		return 0;
	if (end - first > LEAF) {
		err = ask(q, 2 * node + 1, first, half);
		return err ? err : ask(q, 2 * node + 2, half, end);
	}
	for (size_t i = first; i < end && !err; i++)
		err = ask_point(q, q->tree->places[i].point);
	return err;
}

static int compare_along(const void *a, const void *b)
{
	const struct on_edge *one = a, *other = b;

	if (one->along != other->along)
		return one->along < other->along ? -1 : 1;
	return one->point < other->point ? -1 : one->point > other->point;
}

/* List the places on an edge in q->list, from a to b. */
static int ask_edge(struct asking *q, uint32_t a, uint32_t b)
{
	const struct shape *s = q->tree->s;
	int err;

	q->a = a;
	q->b = b;
	q->n = 0;
	q->length = 0;
	for (int k = 0; k < 3; k++) {
		q->from[k] = s->points[a][k];
		q->way[k] = s->points[b][k] - s->points[a][k];
		q->length += q->way[k] * q->way[k];
	}
	q->length = sqrt(q->length);
	if (!(q->length > 0))
		return 0;
	for (int k = 0; k < 3; k++)
		q->way[k] /= q->length;
	err = ask(q, 0, 0, q->tree->n);
	if (!err && q->n)
		qsort(q->list, q->n, sizeof(*q->list), compare_along);
	return err;
}

/* --- Cutting triangles ------------------------------------------------------------------------------------------- */

/* Places along an edge, in the direction of one of its triangles. */
struct cuts {
	const uint32_t *at;
	ptrdiff_t step;
	uint32_t n;
};

/* All edges' places, from a to b, and the range of each triangle's edge among them. */
struct cutting {
	struct shape *s;
	uint32_t *points;
	size_t n_points, room_points;
	struct { size_t first; uint32_t n; } *of_use; /* [3 x faces] */
	struct shape_face *faces;
	size_t n_faces, room_faces;
};

static const double *place_of_vertex(const struct shape *s, uint32_t v)
{
	return s->points[v < s->mesh->vertex_count ? s->point_of[v] : s->made[v - s->mesh->vertex_count].point];
}

static int make_vertex(struct shape *s, uint32_t a, uint32_t b, uint32_t point, uint32_t from, uint32_t *vertex)
{
	const double *begin = place_of_vertex(s, a), *end = place_of_vertex(s, b), *at = s->points[point];
	double along = 0, square = 0;

	for (int k = 0; k < 3; k++) {
		along += (at[k] - begin[k]) * (end[k] - begin[k]);
		square += (end[k] - begin[k]) * (end[k] - begin[k]);
	}
	if (MEMORY_GROW(s->made, s->room_made, s->n_made + 1))
		return ERR_SYSTEM;
	*vertex = s->mesh->vertex_count + (uint32_t)s->n_made;
	s->made[s->n_made++] = (struct shape_made){ a, b, point, (float)(square > 0 ? fmax(0, fmin(1, along / square)) : 0),
		                                    s->mesh->index[3 * (size_t)from + 2] };
	return 0;
}

/* 1 if one edge of a triangle is cut before another: the edge with more places, or with lower ends. The order of
 * corners does not matter. */
static int is_before(const struct shape_face *f, const struct cuts on[3], int k, int other)
{
	const uint32_t a = f->p[k], b = f->p[(k + 1) % 3], c = f->p[other], d = f->p[(other + 1) % 3];
	const uint32_t low = a < b ? a : b, high = a < b ? b : a, other_low = c < d ? c : d, other_high = c < d ? d : c;

	if (on[k].n != on[other].n)
		return on[k].n > on[other].n;
	return low != other_low ? low < other_low : high < other_high;
}

/*
 * Cut a triangle at the middle place of the edge that has most places, then cut its halves. The order of corners is
 * kept, so the last stays last. The same triangle, rotated or mirrored, is cut into the same parts.
 */
static int cut(struct cutting *c, struct shape_face f, const struct cuts on[3])
{
	const int first = is_before(&f, on, 1, 0) ? 1 : 0, k = is_before(&f, on, 2, first) ? 2 : first;
	const uint32_t half = on[k].step > 0 || !on[k].n ? on[k].n / 2 : on[k].n - 1 - on[k].n / 2;
	struct shape_face one = f, other = f;
	struct cuts on_one[3] = { on[0], on[1], on[2] }, on_other[3] = { on[0], on[1], on[2] };
	uint32_t vertex = 0, point;
	int err;

	if (!on[k].n) {
		if (MEMORY_GROW(c->faces, c->room_faces, c->n_faces + 1))
			return ERR_SYSTEM;
		c->faces[c->n_faces++] = f;
		return 0;
	}
	point = on[k].at[on[k].step * (ptrdiff_t)half];
	err = make_vertex(c->s, f.v[k], f.v[(k + 1) % 3], point, f.from, &vertex);
	one.v[(k + 1) % 3] = other.v[k] = vertex;
	one.p[(k + 1) % 3] = other.p[k] = point;
	on_one[k].n = half;
	on_one[(k + 1) % 3].n = 0;
	on_other[k] = (struct cuts){ on[k].at + on[k].step * (ptrdiff_t)(half + 1), on[k].step, on[k].n - half - 1 };
	on_other[(k + 2) % 3].n = 0;
	if (!err)
		err = cut(c, one, on_one);
	return err ? err : cut(c, other, on_other);
}

static int cut_all(struct cutting *c)
{
	struct shape *s = c->s;
	int err = 0;

	for (size_t f = 0; f < s->n_faces && !err; f++) {
		struct cuts on[3];

		for (uint32_t k = 0; k < 3; k++) {
			const size_t first = c->of_use[3 * f + k].first;
			const uint32_t n = c->of_use[3 * f + k].n;
			const int forward = s->faces[f].p[k] < s->faces[f].p[(k + 1) % 3];

			on[k] = n ? (struct cuts){ c->points + (forward ? first : first + n - 1), forward ? 1 : -1,
				                   n } :
			            (struct cuts){ NULL, 1, 0 };
		}
		err = cut(c, s->faces[f], on);
	}
	if (err)
		return err;
	free(s->faces);
	s->faces = c->faces;
	s->n_faces = c->n_faces;
	s->room_faces = c->room_faces;
	c->faces = NULL;
	return 0;
}

/* Find the places on all edges. @param found  as for junctions_mend */
static int find_cuts(struct cutting *c, const struct tree *tree, const struct shape_edge *edges, size_t n,
                     uint32_t *found)
{
	struct asking q = { .tree = tree };
	int err = 0, balance;

	for (size_t first = 0, end; first < n && !err; first = end) {
		end = shape_run_end(c->s, edges, n, first, &balance);
		err = ask_edge(&q, edges[first].a, edges[first].b);
		if (!err && q.n)
			err = MEMORY_GROW(c->points, c->room_points, c->n_points + q.n);
		if (err || !q.n)
			continue;
		for (size_t i = first; i < end; i++) {
			c->of_use[edges[i].use].first = c->n_points;
			c->of_use[edges[i].use].n = (uint32_t)q.n;
		}
		for (size_t i = 0; i < q.n; i++)
			c->points[c->n_points++] = q.list[i].point;
		*found += (uint32_t)q.n;
	}
	free(q.list);
	return err;
}

/*
 * Mark the ends of open edges: the triangles do not run half each way, or their number is odd when two back to back
 * count as one.
 * marks: [n_points], receives 1. backs: [n_faces], 1 for the second of two back to back. @return number of open edges
 */
static size_t mark_open(const struct shape *s, const struct shape_edge *edges, size_t n, const uint8_t *backs,
                        uint8_t *marks)
{
	size_t open = 0;
	int balance;

	for (size_t first = 0, end; first < n; first = end) {
		size_t all = 0;

		end = shape_run_end(s, edges, n, first, &balance);
		for (size_t i = first; i < end; i++)
			all += !backs[edges[i].use / 3];
		if (!balance && all % 2 == 0)
			continue;
		marks[edges[first].a] = marks[edges[first].b] = 1;
		open++;
	}
	return open;
}

int junctions_mend(struct shape *s, uint32_t *found)
{
	struct cutting c = { .s = s };
	struct shape_edge *edges;
	struct tree tree = { .n = 0 };
	uint8_t *marks = calloc(s->n_points + (size_t)1, 1), *backs = NULL;
	size_t n;
	int err = shape_list_edges(s, &edges, &n);

	*found = 0;
	c.of_use = calloc(3 * s->n_faces + 1, sizeof(*c.of_use));
	if (!err && (!marks || !c.of_use))
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		err = doubles_find_backs(s, &backs);
	if (!err && mark_open(s, edges, n, backs, marks)) {
		err = plant(&tree, s, marks);
		if (!err)
			err = find_cuts(&c, &tree, edges, n, found);
		if (!err && *found)
			err = cut_all(&c);
	}
	fell(&tree);
	free(c.points);
	free(c.of_use);
	free(c.faces);
	free(edges);
	free(marks);
	free(backs);
	return err;
}
