/* Turns the faces of each shell to one side, and of closed bodies outwards. */
#include "scene/repair/turn.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "scene/repair/shape.h"

/* A connected part of the mesh. */
struct shell {
	uint32_t first, end; /* in `order` */
	double low[3], high[3];
	double area, turned; /* area of all its faces, and of those turned */
	uint32_t largest;    /* its largest face */
};

struct turning {
	struct shape *s;
	uint32_t *partner; /* [3 x faces]: the edge's other use; SCENE_NONE unless it has two */
	uint8_t *turned;   /* [faces] */
	uint8_t *seen;     /* [faces] */
	uint32_t *order;   /* faces, shell by shell */
	struct shell *shells;
	uint32_t n_shells;
	int even; /* 1: every edge has an even number of triangles */
};

static int find_partners(struct turning *t)
{
	struct shape_edge *edges;
	size_t n;
	int err = shape_list_edges(t->s, &edges, &n), balance;

	memset(t->partner, 0xff, (3 * t->s->n_faces + 1) * sizeof(*t->partner));
	t->even = n > 0;
	for (size_t first = 0, end; first < n && !err; first = end) {
		end = shape_run_end(t->s, edges, n, first, &balance);
		t->even &= (end - first) % 2 == 0;
		if (end - first == 2) {
			t->partner[edges[first].use] = edges[first + 1].use;
			t->partner[edges[first + 1].use] = edges[first].use;
		}
	}
	free(edges);
	return err;
}

static void add_to_shell(const struct turning *t, struct shell *shell, uint32_t face, double *most)
{
	double normal[3];
	const double area = shape_normal(t->s, &t->s->faces[face], normal);

	shell->area += area;
	shell->turned += t->turned[face] ? area : 0;
	if (area > *most) {
		*most = area;
		shell->largest = face;
	}
	for (int k = 0; k < 3; k++)
		for (int c = 0; c < 3; c++) {
			const double at = t->s->points[t->s->faces[face].p[c]][k];

			shell->low[k] = fmin(shell->low[k], at);
			shell->high[k] = fmax(shell->high[k], at);
		}
}

/* Collect one shell from a start face, turning all its faces as that one is. at: next position in `order`. @return the
 * position after it */
static uint32_t gather(struct turning *t, uint32_t start, uint32_t at)
{
	struct shell *shell = &t->shells[t->n_shells++];
	double most = -1;

	*shell = (struct shell){ at, at, { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY }, 0, 0, start };
	t->order[shell->end++] = start;
	t->seen[start] = 1;
	for (; at < shell->end; at++) {
		const uint32_t face = t->order[at];

		add_to_shell(t, shell, face, &most);
		for (uint32_t k = 0; k < 3; k++) {
			const uint32_t use = t->partner[3 * face + k], next = use / 3;

			if (use == SCENE_NONE || t->seen[next])
				continue;
			/* Neighbours run against each other along their edge. */
			t->turned[next] = (uint8_t)(t->turned[face] ^ (t->s->faces[face].p[k] == t->s->faces[next].p[use % 3]));
			t->seen[next] = 1;
			t->order[shell->end++] = next;
		}
	}
	return at;
}

/* 1 if a ray meets a triangle beyond its start (Moeller and Trumbore 1997). */
static int meets(const struct shape *s, const struct shape_face *f, const double from[3], const double d[3])
{
	const double *a = s->points[f->p[0]];
	double one[3], other[3], to[3], p[3], q[3], det = 0, u = 0, v = 0, along = 0;

	for (int k = 0; k < 3; k++) {
		one[k] = s->points[f->p[1]][k] - a[k];
		other[k] = s->points[f->p[2]][k] - a[k];
		to[k] = from[k] - a[k];
	}
	for (int k = 0; k < 3; k++) {
		const int i = (k + 1) % 3, j = (k + 2) % 3;

		p[k] = d[i] * other[j] - d[j] * other[i];
		q[k] = to[i] * one[j] - to[j] * one[i];
	}
	for (int k = 0; k < 3; k++) {
		det += one[k] * p[k];
		u += to[k] * p[k];
		v += d[k] * q[k];
		along += other[k] * q[k];
	}
	return det != 0 && u / det >= 0 && v / det >= 0 && (u + v) / det <= 1 && along / det > 1e-9 * s->size;
}

static int meets_box(const struct shell *shell, const double from[3], const double d[3])
{
	double near = 0, far = INFINITY;

	for (int k = 0; k < 3; k++) {
		const double low = (shell->low[k] - from[k]) / d[k], high = (shell->high[k] - from[k]) / d[k];

		if (d[k] == 0 && (from[k] < shell->low[k] || from[k] > shell->high[k]))
			return 0;
		near = d[k] != 0 ? fmax(near, fmin(low, high)) : near;
		far = d[k] != 0 ? fmin(far, fmax(low, high)) : far;
	}
	return near <= far * (1 + 1e-9);
}

/* 1 if a shell faces inwards: most of three rays from its largest face, to the side it faces, cross an odd number of
 * faces. */
static int looks_inwards(const struct turning *t, const struct shell *shell)
{
	static const double aside[3][3] = { { 0.13, 0.071, -0.037 }, { -0.053, 0.117, 0.089 }, { 0.023, -0.101, 0.149 } };
	const struct shape *s = t->s;
	const struct shape_face *face = &s->faces[shell->largest];
	double normal[3], from[3], length = shape_normal(s, face, normal);
	int odd = 0;

	for (int k = 0; k < 3; k++) {
		from[k] = (s->points[face->p[0]][k] + s->points[face->p[1]][k] + s->points[face->p[2]][k]) / 3;
		normal[k] = length > 0 ? normal[k] / length * (t->turned[shell->largest] ? -1 : 1) : 0;
	}
	for (int ray = 0; ray < 3; ray++) {
		const double d[3] = { normal[0] + aside[ray][0], normal[1] + aside[ray][1], normal[2] + aside[ray][2] };
		int met = 0;

		for (uint32_t i = 0; i < t->n_shells; i++)
			for (uint32_t k = t->shells[i].first; k < t->shells[i].end && meets_box(&t->shells[i], from, d); k++)
				met += t->order[k] != shell->largest && meets(s, &s->faces[t->order[k]], from, d);
		odd += met % 2;
	}
	return odd >= 2;
}

/* Keep the last corner last: under flat shading it gives the colour. */
static void turn_face(struct shape_face *f)
{
	const uint32_t v = f->v[0], p = f->p[0];

	f->v[0] = f->v[1];
	f->p[0] = f->p[1];
	f->v[1] = v;
	f->p[1] = p;
}

static void turn_shell(struct turning *t, const struct shell *shell)
{
	const int clockwise = t->s->wants->clockwise;
	const int all = t->even ? looks_inwards(t, shell) ^ clockwise : shell->turned > shell->area / 2;

	for (uint32_t i = shell->first; i < shell->end; i++) {
		if (t->turned[t->order[i]] == all)
			continue;
		turn_face(&t->s->faces[t->order[i]]);
		t->s->found->turned++;
	}
}

int turn_outwards(struct shape *s, int turns)
{
	const size_t n = s->n_faces;
	struct turning t = { .s = s,
		             .partner = malloc((3 * n + 1) * sizeof(*t.partner)),
		             .turned = calloc(n + 1, 1),
		             .seen = calloc(n + 1, 1),
		             .order = malloc((n + 1) * sizeof(*t.order)),
		             .shells = malloc((n + 1) * sizeof(*t.shells)) };
	int err = t.partner && t.turned && t.seen && t.order && t.shells ?
	                  find_partners(&t) :
	                  err_report(ERR_SYSTEM, NULL, "out of memory");

	for (uint32_t f = 0, at = 0; f < n && !err; f++)
		if (!t.seen[f] && s->faces[f].p[0] != SCENE_NONE)
			at = gather(&t, f, at);
	for (uint32_t i = 0; i < t.n_shells && turns && !err; i++)
		turn_shell(&t, &t.shells[i]);
	s->found->shells = t.n_shells;
	free(t.partner);
	free(t.turned);
	free(t.seen);
	free(t.order);
	free(t.shells);
	return err;
}
