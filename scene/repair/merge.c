/* Removes vertices of flat regions by edge collapses. */
#include "scene/repair/merge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/vec3.h"
#include "scene/repair/shape.h"

/* MOST_AROUND: a place with more triangles stays. PASSES: each pass removes only places that are not neighbours. */
enum { MOST_AROUND = 32, PASSES = 24 };
/* Attributes are linear if they deviate by no more than this share of 1 or of their size. */
#define EVEN 1e-4

struct merging {
	struct shape *s;
	struct shape_attribute list[SHAPE_MOST_ATTRIBUTES];
	size_t n_attributes;
	uint32_t *first, *around; /* faces of place p: around[first[p] .. first[p + 1]) */
	uint8_t *locked;          /* [n_points]: 1 if `around` lacks faces that the place has gained */
	uint8_t *gone;            /* [n_faces] */
};

/* A place with its triangles; the place is corner `at` of each. */
struct ring {
	uint32_t p, n, faces[MOST_AROUND], at[MOST_AROUND], next[MOST_AROUND], previous[MOST_AROUND];
	int side[MOST_AROUND]; /* index of its plane */
	int sides;
	double normal[2][3];
	const struct shape_face *ref[2]; /* the first triangle of each plane */
};

/* Collect the triangles around a place. @return 0: they do not form a complete disk */
static int find_ring(const struct merging *m, uint32_t p, struct ring *r)
{
	*r = (struct ring){ .p = p };
	for (uint32_t i = m->first[p]; i < m->first[p + 1]; i++) {
		const struct shape_face *f = &m->s->faces[m->around[i]];
		const uint32_t at = f->p[0] == p ? 0 : f->p[1] == p ? 1 : 2;

		if (m->gone[m->around[i]])
			continue;
		if (r->n == MOST_AROUND)
			return 0;
		r->faces[r->n] = m->around[i];
		r->at[r->n] = at;
		r->next[r->n] = f->p[(at + 1) % 3];
		r->previous[r->n++] = f->p[(at + 2) % 3];
	}
	for (uint32_t i = 0; i < r->n; i++) {
		int before = 0, same = 0;

		for (uint32_t k = 0; k < r->n; k++) {
			before += r->previous[k] == r->next[i];
			same += r->next[k] == r->next[i];
		}
		if (before != 1 || same != 1)
			return 0;
	}
	return r->n >= 3;
}

/* 1 if a face lies in a plane of the ring. */
static int is_in_plane(const struct merging *m, const struct ring *r, const struct shape_face *f, int side)
{
	double own[3], to[3];

	if (shape_normal(m->s, f, own) <= 0 || vec3_dot(own, r->normal[side]) <= 0)
		return 0;
	for (int c = 0; c < 3; c++) {
		for (int k = 0; k < 3; k++)
			to[k] = m->s->points[f->p[c]][k] - m->s->points[r->p][k];
		if (fabs(vec3_dot(to, r->normal[side])) > m->s->tolerance)
			return 0;
	}
	return 1;
}

/* Assign each face to a plane. @return 0: there are more than two planes */
static int find_planes(const struct merging *m, struct ring *r)
{
	for (uint32_t i = 0; i < r->n; i++) {
		const struct shape_face *f = &m->s->faces[r->faces[i]];
		int side = 0;

		while (side < r->sides && !is_in_plane(m, r, f, side))
			side++;
		if (side == 2)
			return 0;
		if (side == r->sides) {
			const double length = shape_normal(m->s, f, r->normal[side]);

			for (int k = 0; k < 3; k++)
				r->normal[side][k] /= length;
			r->ref[r->sides++] = f;
			if (!(length > 0))
				return 0;
		}
		r->side[i] = side;
	}
	return 1;
}

/* Barycentric weights of a place in a triangle's plane. */
static void weigh(const struct shape *s, const struct shape_face *f, const double at[3], double out[3])
{
	double whole[3], part[3];
	const double square = pow(shape_normal(s, f, whole), 2);

	for (int c = 0; c < 3; c++) {
		const double *a = s->points[f->p[(c + 1) % 3]], *b = s->points[f->p[(c + 2) % 3]];

		for (int k = 0; k < 3; k++) {
			const int i = (k + 1) % 3, j = (k + 2) % 3;

			part[k] = (a[i] - at[i]) * (b[j] - at[j]) - (b[i] - at[i]) * (a[j] - at[j]);
		}
		out[c] = vec3_dot(part, whole) / square;
	}
}

/* 1 if a triangle's attributes continue those of its plane's first triangle linearly, and both come from the same
 * draw. */
static int goes_on(const struct merging *m, const struct shape_face *ref, const struct shape_face *f)
{
	const uint32_t *draw = m->s->mesh->primitive_draw;

	if (draw && draw[ref->from] != draw[f->from])
		return 0;
	for (int c = 0; c < 3; c++) {
		double w[3];

		weigh(m->s, ref, m->s->points[f->p[c]], w);
		for (size_t i = 0; i < m->n_attributes; i++) {
			const struct shape_attribute *a = &m->list[i];
			const float *own = *a->array + a->each * f->v[c];
			const int is_one = a->is_color && m->s->wants->flat;

			for (size_t k = 0; k < a->each; k++) {
				double even = 0;

				for (int corner = 0; corner < 3; corner++)
					even += (is_one ? corner == 2 : w[corner]) * (double)(*a->array)[a->each * ref->v[corner] + k];
				if (!(fabs(even - (double)own[k]) <= EVEN * fmax(1, fabs(even))))
					return 0;
			}
		}
	}
	return 1;
}

/* 1 if q is an end of the straight edge between the ring's two planes; with one plane, any neighbour qualifies. */
static int is_along(const struct merging *m, const struct ring *r, uint32_t q)
{
	uint32_t ends[2], n = 0;
	double way[3], to[3];

	if (r->sides == 1)
		return 1;
	for (uint32_t i = 0; i < r->n; i++)
		for (uint32_t k = 0; k < r->n; k++)
			if (r->next[i] == r->previous[k] && r->side[i] != r->side[k]) {
				if (n == 2)
					return 0;
				ends[n++] = r->next[i];
			}
	if (n != 2 || (q != ends[0] && q != ends[1]))
		return 0;
	for (int k = 0; k < 3; k++) {
		way[k] = m->s->points[ends[1]][k] - m->s->points[ends[0]][k];
		to[k] = m->s->points[r->p][k] - m->s->points[ends[0]][k];
	}
	const double along = vec3_dot(to, way) / vec3_dot(way, way);

	for (int k = 0; k < 3; k++)
		to[k] -= along * way[k];
	return along > 0 && along < 1 && sqrt(vec3_dot(to, to)) <= m->s->tolerance;
}

static int is_neighbour(const struct ring *r, uint32_t p)
{
	for (uint32_t i = 0; i < r->n; i++)
		if (r->next[i] == p)
			return 1;
	return 0;
}

/* 1 if the place may collapse to q: the surface stays connected, and no triangle flips or becomes narrow. */
static int can_become(const struct merging *m, const struct ring *r, uint32_t q)
{
	uint32_t shared = 0;

	for (uint32_t i = m->first[q]; i < m->first[q + 1]; i++) {
		const struct shape_face *f = &m->s->faces[m->around[i]];

		for (int c = 0; c < 3 && !m->gone[m->around[i]]; c++)
			shared += f->p[c] == q && is_neighbour(r, f->p[(c + 1) % 3]);
	}
	if (shared != 2)
		return 0;
	for (uint32_t i = 0; i < r->n; i++) {
		struct shape_face f = m->s->faces[r->faces[i]];
		double normal[3], length, most = 0;

		if (r->next[i] == q || r->previous[i] == q)
			continue;
		f.p[r->at[i]] = q;
		length = shape_normal(m->s, &f, normal);
		for (int c = 0; c < 3; c++)
			for (int k = 0; k < 3; k++)
				most = fmax(most, fabs(m->s->points[f.p[c]][k] - m->s->points[f.p[(c + 1) % 3]][k]));
		if (!(vec3_dot(normal, r->normal[r->side[i]]) > 4 * m->s->tolerance * most) ||
		    !is_in_plane(m, r, &f, r->side[i]) || !(length > 0))
			return 0;
	}
	return 1;
}

static void become(struct merging *m, const struct ring *r, uint32_t q)
{
	uint32_t vertex[2] = { 0, 0 };

	for (uint32_t i = 0; i < r->n; i++) {
		const struct shape_face *f = &m->s->faces[r->faces[i]];

		if (r->next[i] != q && r->previous[i] != q)
			continue;
		vertex[r->side[i]] = f->v[(r->at[i] + (r->next[i] == q ? 1 : 2)) % 3];
		m->gone[r->faces[i]] = 1;
	}
	for (uint32_t i = 0; i < r->n; i++) {
		m->s->faces[r->faces[i]].p[r->at[i]] = q;
		m->s->faces[r->faces[i]].v[r->at[i]] = vertex[r->side[i]];
	}
	m->locked[r->p] = m->locked[q] = 1;
}

/* Remove a place if possible. @return 1: removed */
static int take_away(struct merging *m, uint32_t p)
{
	struct ring r;

	if (m->locked[p] || !find_ring(m, p, &r) || !find_planes(m, &r))
		return 0;
	for (uint32_t i = 0; i < r.n; i++)
		if (!goes_on(m, r.ref[r.side[i]], &m->s->faces[r.faces[i]]))
			return 0;
	for (uint32_t i = 0; i < r.n; i++)
		if (!m->locked[r.next[i]] && is_along(m, &r, r.next[i]) && can_become(m, &r, r.next[i])) {
			become(m, &r, r.next[i]);
			return 1;
		}
	return 0;
}

static void find_around(struct merging *m)
{
	const struct shape *s = m->s;

	memset(m->first, 0, (s->n_points + (size_t)2) * sizeof(*m->first));
	memset(m->locked, 0, s->n_points);
	memset(m->gone, 0, s->n_faces);
	for (size_t i = 0; i < 3 * s->n_faces; i++)
		if (s->faces[i / 3].p[0] != SCENE_NONE)
			m->first[s->faces[i / 3].p[i % 3] + 2]++;
	for (uint32_t p = 0; p < s->n_points; p++)
		m->first[p + 2] += m->first[p + 1];
	for (size_t i = 0; i < 3 * s->n_faces; i++)
		if (s->faces[i / 3].p[0] != SCENE_NONE)
			m->around[m->first[s->faces[i / 3].p[i % 3] + 1]++] = (uint32_t)(i / 3);
}

int merge_flat(struct shape *s, uint32_t *merged)
{
	struct scene_mesh arrays = *s->mesh;
	struct merging m = { .s = s,
		             .first = malloc((s->n_points + (size_t)2) * sizeof(*m.first)),
		             .around = malloc((3 * s->n_faces + 1) * sizeof(*m.around)),
		             .locked = malloc(s->n_points + (size_t)1),
		             .gone = malloc(s->n_faces + 1) };
	const int err = m.first && m.around && m.locked && m.gone ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
	uint32_t went = 1;

	*merged = 0;
	m.n_attributes = shape_list_attributes(&arrays, m.list);
	for (int pass = 0; pass < PASSES && went && !err; pass++) {
		went = 0;
		find_around(&m);
		for (uint32_t p = 0; p < s->n_points; p++)
			went += (uint32_t)take_away(&m, p);
		shape_drop(s, m.gone);
		*merged += went;
	}
	free(m.first);
	free(m.around);
	free(m.locked);
	free(m.gone);
	return err;
}
