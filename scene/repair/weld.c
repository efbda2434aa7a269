/* Welds vertices that are closer together than the tolerance: sorts them along a direction, and joins neighbours. */
#include "scene/repair/weld.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "scene/repair/shape.h"

/* Along this direction few places coincide, as walls and rows of vertices in programs are hardly ever perpendicular to
 * it. */
static const double skew[3] = { 0.6270473, 0.5391827, 0.5623719 };
/* Error that rounding to floats adds to a distance, as a share of the largest coordinate. */
#define RESOLVED 2.4e-7

/* A vertex during welding. */
struct seat {
	double along; /* position along the skew direction */
	uint32_t vertex;
	uint32_t root; /* the seat it is joined to, which may itself be joined to another */
};

static const float *position(const struct shape *s, uint32_t vertex)
{
	return s->mesh->position + 4 * (size_t)vertex;
}

static int compare_seats(const void *a, const void *b)
{
	const struct seat *one = a, *other = b;

	if (one->along != other->along)
		return one->along < other->along ? -1 : 1;
	return one->vertex < other->vertex ? -1 : one->vertex > other->vertex;
}

static uint32_t root_of(struct seat *seats, uint32_t i)
{
	while (seats[i].root != i)
		i = seats[i].root = seats[seats[i].root].root;
	return i;
}

static double distance(const float *a, const float *b)
{
	const double x = (double)a[0] - (double)b[0], y = (double)a[1] - (double)b[1], z = (double)a[2] - (double)b[2];

	return sqrt(x * x + y * y + z * z);
}

/* List the vertices that triangles use, and measure the mesh. @return their number */
static uint32_t list_seats(struct shape *s, struct seat *seats)
{
	const struct scene_mesh *mesh = s->mesh;
	double low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY }, square = 0, most = 0;
	uint32_t n = 0;

	for (size_t i = 0; i < 3 * (size_t)mesh->primitive_count; i++) {
		const uint32_t vertex = mesh->index[i];
		const float *at = position(s, vertex);

		if (s->point_of[vertex] != SCENE_NONE || !isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2]))
			continue;
		s->point_of[vertex] = 0;
		seats[n] = (struct seat){ (double)at[0] * skew[0] + (double)at[1] * skew[1] + (double)at[2] * skew[2], vertex, 0 };
		n++;
		for (int k = 0; k < 3; k++) {
			low[k] = fmin(low[k], at[k]);
			high[k] = fmax(high[k], at[k]);
			most = fmax(most, fabs(at[k]));
		}
	}
	for (int k = 0; k < 3 && n; k++)
		square += (high[k] - low[k]) * (high[k] - low[k]);
	s->size = sqrt(square);
	s->tolerance = s->wants->weld > 0 ? fmin(s->wants->weld, REPAIR_MOST_WELD) * s->size + RESOLVED * most : 0;
	return n;
}

/* Join seats within the tolerance. Equal positions are adjacent, except for others with the same sum; only the first of
 * equal positions searches on. */
static void join(const struct shape *s, struct seat *seats, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++)
		seats[i].root = i;
	for (uint32_t i = 0; i < n; i++) {
		const float *at = position(s, seats[i].vertex);

		if (seats[i].root != i && distance(at, position(s, seats[seats[i].root].vertex)) == 0)
			continue;
		for (uint32_t k = i + 1; k < n && seats[k].along - seats[i].along <= s->tolerance; k++) {
			const uint32_t one = root_of(seats, i), other = root_of(seats, k);

			if (one != other && distance(at, position(s, seats[k].vertex)) <= s->tolerance)
				seats[one > other ? one : other].root = one > other ? other : one;
		}
	}
}

/* Move each place to the position of its vertices, or to their mean. sums: [n][4] */
static void settle(struct shape *s, struct seat *seats, uint32_t n, double (*sums)[4])
{
	for (uint32_t i = 0; i < n; i++) {
		double *sum = sums[root_of(seats, i)];

		for (int k = 0; k < 3; k++)
			sum[k] += (double)position(s, seats[i].vertex)[k];
		sum[3]++;
	}
	for (uint32_t i = 0; i < n; i++) {
		const uint32_t root = root_of(seats, i);

		if (root == i)
			memcpy(s->points[s->n_points++],
			       (double[3]){ position(s, seats[i].vertex)[0], position(s, seats[i].vertex)[1],
			                    position(s, seats[i].vertex)[2] },
			       sizeof(*s->points));
		s->point_of[seats[i].vertex] = root == i ? s->n_points - 1 : s->point_of[seats[root].vertex];
		if (distance(position(s, seats[i].vertex), position(s, seats[root].vertex)) > 0)
			for (int k = 0; k < 3; k++) /* the place is no longer at its root's position */
				s->points[s->point_of[seats[i].vertex]][k] = (float)(sums[root][k] / sums[root][3]);
	}
	for (uint32_t i = 0; i < n; i++)
		for (int k = 0; k < 3; k++)
			if ((double)position(s, seats[i].vertex)[k] != s->points[s->point_of[seats[i].vertex]][k]) {
				s->found->welded++;
				break;
			}
}

int weld_points(struct shape *s)
{
	const size_t room = s->mesh->vertex_count + (size_t)1;
	struct seat *seats = malloc(room * sizeof(*seats));
	double (*sums)[4] = calloc(room, sizeof(*sums));
	uint32_t n;

	s->points = malloc(room * sizeof(*s->points));
	s->point_of = malloc(room * sizeof(*s->point_of));
	if (seats && sums && s->points && s->point_of) {
		memset(s->point_of, 0xff, room * sizeof(*s->point_of));
		n = list_seats(s, seats);
		qsort(seats, n, sizeof(*seats), compare_seats);
		join(s, seats, n);
		settle(s, seats, n, sums);
	}
	free(seats);
	free(sums);
	return seats && sums && s->points && s->point_of ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
}
