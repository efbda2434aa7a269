#include "look/spare/blockers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/mat4.h"
#include "base/optimize.h"
#include "base/vec3.h"
#include "look/draws/corner.h"
#include "look/spare/sides.h"
#include "scene/backdrop.h"
#include "scene/depths.h"

/* Boxes are larger than their triangles by this share of the coordinates in eye space. */
#define MARGIN 1e-4f
#define CLUSTER 32u /* triangles that share a box; neighbours in a mesh are mostly close together */
#define GROUP 32u   /* clusters that share a box */

struct box {
	float low[3], high[3];
};

struct blockers {
	const struct scene *scene;
	struct box *boxes;       /* for each mesh: boxes of its clusters, then of its groups of clusters */
	uint32_t *first;         /* [mesh]: index of its first box; SCENE_NONE: it has none */
	float (*eye_inverse)[16]; /* [instance]: from eye to object space */
	struct box *around;      /* [instance]: box in eye space, for those that block */
	uint8_t *blocks;         /* [instance] */
};

int blockers_can(const struct scene *s, uint32_t instance, int is_depth)
{
	const struct scene_instance *in = &s->instances[instance];
	const struct scene_material *m = &s->materials[in->material];

	if (!(m->color_mask & 7 || is_depth) || scene_is_never_drawn(m))
		return 0;
	return instance >= scene_backdrop(s) && s->meshes[in->mesh]->kind == SCENE_TRIANGLES &&
	       s->views[in->view].target == 0 && !in->rectangle && m->depth_test && (!m->blend || m->depth_write) &&
	       !m->alpha_test && !m->logic_op && !(m->surface.transmit > 0) &&
	       !(m->surface.hidden & SCENE_HIDDEN_FROM_LIGHTS);
}

static uint32_t cluster_count(const struct scene_mesh *mesh)
{
	return (mesh->primitive_count + CLUSTER - 1) / CLUSTER;
}

static uint32_t group_count(const struct scene_mesh *mesh)
{
	return (cluster_count(mesh) + GROUP - 1) / GROUP;
}

static const struct box nowhere = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

/* Extend a box to contain everything between low and high. */
static void widen(struct box *box, const float low[3], const float high[3])
{
	for (int k = 0; k < 3; k++) {
		box->low[k] = low[k] < box->low[k] ? low[k] : box->low[k];
		box->high[k] = high[k] > box->high[k] ? high[k] : box->high[k];
	}
}

/* Corners have a fourth number, which is ignored: compilers then use one instruction for all four. */
OPTIMIZE("O3")
static struct box box_cluster(const struct scene_mesh *mesh, uint32_t cluster)
{
	float low[4] = { INFINITY, INFINITY, INFINITY, INFINITY }, high[4] = { -INFINITY, -INFINITY, -INFINITY, -INFINITY };

	for (uint32_t i = cluster * CLUSTER; i < (cluster + 1) * CLUSTER && i < mesh->primitive_count; i++)
		for (unsigned c = 0; c < 3; c++) {
			const float *corner = mesh->position + 4 * (size_t)mesh->index[3 * (size_t)i + c];

			for (int k = 0; k < 4; k++) {
				low[k] = corner[k] < low[k] ? corner[k] : low[k];
				high[k] = corner[k] > high[k] ? corner[k] : high[k];
			}
		}
	return (struct box){ { low[0], low[1], low[2] }, { high[0], high[1], high[2] } };
}

/* Compute all boxes of a mesh. */
static void box_mesh(const struct scene_mesh *mesh, struct box *boxes)
{
	const uint32_t n = cluster_count(mesh);

	for (uint32_t i = 0; i < group_count(mesh); i++)
		boxes[n + i] = nowhere;
	for (uint32_t i = 0; i < n; i++) {
		boxes[i] = box_cluster(mesh, i);
		widen(&boxes[n + i / GROUP], boxes[i].low, boxes[i].high);
	}
}

/* A box in eye space around all groups of an instance, with a margin. */
static struct box box_around(const struct blockers *b, const struct scene_instance *in)
{
	const struct scene_mesh *mesh = b->scene->meshes[in->mesh];
	struct box out = nowhere;
	float far = 0;

	for (uint32_t i = 0; i < group_count(mesh); i++) {
		const struct box *box = &b->boxes[b->first[in->mesh] + cluster_count(mesh) + i];

		for (unsigned c = 0; c < 8; c++) {
			const float corner[4] = { c & 1 ? box->high[0] : box->low[0],
				                  c & 2 ? box->high[1] : box->low[1],
				                  c & 4 ? box->high[2] : box->low[2], 1 };
			float eye[4];

			mat4_transform(eye, in->modelview, corner);
			for (int k = 0; k < 3; k++) {
				out.low[k] = fminf(out.low[k], eye[k]);
				out.high[k] = fmaxf(out.high[k], eye[k]);
				far = fmaxf(far, fabsf(eye[k]));
			}
			if (eye[3] != 1)
				far = INFINITY;
		}
	}
	for (int k = 0; k < 3; k++) {
		out.low[k] -= MARGIN * far;
		out.high[k] += MARGIN * far;
	}
	return out;
}

/* Compute the boxes of all meshes and instances that block. */
static int make_boxes(struct blockers *b)
{
	const struct scene *s = b->scene;
	size_t n = 0;

	for (uint32_t i = 0; i < s->n_meshes; i++)
		b->first[i] = SCENE_NONE;
	scene_find_depths(s, b->blocks);
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];

		b->blocks[i] = (uint8_t)(blockers_can(s, i, b->blocks[i]) &&
		                         mat4_invert(b->eye_inverse[i], in->modelview));
		if (!b->blocks[i] || b->first[in->mesh] != SCENE_NONE)
			continue;
		b->first[in->mesh] = (uint32_t)n;
		n += cluster_count(s->meshes[in->mesh]) + group_count(s->meshes[in->mesh]);
	}
	b->boxes = malloc((n + 1) * sizeof(*b->boxes));
	if (!b->boxes)
		return ERR_SYSTEM;
	for (uint32_t i = 0; i < s->n_meshes; i++)
		if (b->first[i] != SCENE_NONE)
			box_mesh(s->meshes[i], &b->boxes[b->first[i]]);
	for (uint32_t i = 0; i < s->n_instances; i++)
		if (b->blocks[i])
			b->around[i] = box_around(b, &s->instances[i]);
	return 0;
}

int blockers_create(const struct scene *scene, struct blockers **out)
{
	struct blockers *b = calloc(1, sizeof(*b));

	*out = b;
	if (!b)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	b->scene = scene;
	b->first = malloc((scene->n_meshes + (size_t)1) * sizeof(*b->first));
	b->eye_inverse = malloc((scene->n_instances + (size_t)1) * sizeof(*b->eye_inverse));
	b->blocks = calloc(scene->n_instances + (size_t)1, sizeof(*b->blocks));
	b->around = malloc((scene->n_instances + (size_t)1) * sizeof(*b->around));
	if (b->first && b->eye_inverse && b->blocks && b->around && make_boxes(b) == 0)
		return 0;
	blockers_destroy(out);
	return err_report(ERR_SYSTEM, NULL, "out of memory");
}

void blockers_destroy(struct blockers **blockers)
{
	struct blockers *b = *blockers;

	if (!b)
		return;
	free(b->boxes);
	free(b->first);
	free(b->eye_inverse);
	free(b->around);
	free(b->blocks);
	free(b);
	*blockers = NULL;
}

int blockers_has(const struct blockers *b, uint32_t instance)
{
	return b->blocks[instance];
}

/* --- Rays, in eye space ------------------------------------------------------------------------------------------ */

/* A ray prepared for boxes: 1 / direction, and the rounding error of positions along it. */
struct sight {
	float from[3], over[3], t_max, margin;
};

static struct sight sight_of(const float from[3], const float direction[3], float t_max)
{
	struct sight s = { .t_max = t_max };

	for (int k = 0; k < 3; k++) {
		s.from[k] = from[k];
		s.over[k] = 1 / direction[k];
		s.margin = fmaxf(s.margin, MARGIN * fabsf(from[k]));
	}
	return s;
}

/* 0 if the ray misses the box. NaN counts as a hit. */
static int may_meet(const struct sight *s, const struct box *box)
{
	float near = 0, far = s->t_max;

	for (int k = 0; k < 3; k++) {
		const float a = (box->low[k] - s->margin - s->from[k]) * s->over[k],
			    b = (box->high[k] + s->margin - s->from[k]) * s->over[k];
		const float first = a < b ? a : b, last = a < b ? b : a;

		near = first > near ? first : near;
		far = last < far ? last : far;
	}
	return !(near > far * 1.001f);
}

/* --- Rays, in object space --------------------------------------------------------------------------------------- */

struct line {
	float from[3], d[3], t_max;
};

static int meets_box(const struct line *r, const struct box *box)
{
	float near = 0, far = r->t_max;

	for (int k = 0; k < 3; k++) {
		float a = (box->low[k] - r->from[k]) / r->d[k], b = (box->high[k] - r->from[k]) / r->d[k];

		if (r->d[k] == 0) {
			if (r->from[k] < box->low[k] || r->from[k] > box->high[k])
				return 0;
			continue;
		}
		near = fmaxf(near, fminf(a, b));
		far = fminf(far, fmaxf(a, b));
	}
	return near <= far * 1.00001f;
}

/* The position along a line where it meets a triangle (Moeller and Trumbore 1997); 0: nowhere */
static float meet_triangle(const struct line *r, const float *a, const float *b, const float *c)
{
	float ab[3], ac[3], p[3], q[3], s[3], det, u, v, t;

	for (int k = 0; k < 3; k++) {
		ab[k] = b[k] - a[k];
		ac[k] = c[k] - a[k];
		s[k] = r->from[k] - a[k];
	}
	vec3f_cross(r->d, ac, p);
	det = vec3f_dot(ab, p);
	u = vec3f_dot(s, p) / det;
	vec3f_cross(s, ab, q);
	v = vec3f_dot(r->d, q) / det;
	t = vec3f_dot(ac, q) / det;
	return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < r->t_max ? t : 0;
}

static enum blocker_side side_met(const struct blockers *b, const struct scene_instance *in, uint32_t primitive,
                                  const float d[3])
{
	const struct sides sides = sides_of(b->scene, in);
	double towards[3];

	if (sides.shown == SIDES_BOTH)
		return BLOCKER_UNKNOWN_SIDE;
	sides_towards(b->scene, in, sides, primitive, towards);
	return towards[0] * d[0] + towards[1] * d[1] + towards[2] * d[2] < 0 ? BLOCKER_SHOWN : BLOCKER_OTHER;
}

/* The first cluster from k on whose group the line meets. A group's box contains those of its clusters. */
static uint32_t next_cluster(const struct line *r, const struct box *groups, uint32_t k, uint32_t n)
{
	while (k % GROUP == 0 && k < n && !meets_box(r, &groups[k / GROUP]))
		k += GROUP;
	return k;
}

static unsigned meet_instance(const struct blockers *b, uint32_t i, const struct line *r, struct blocker_hit *out,
                              unsigned n)
{
	const struct scene_instance *in = &b->scene->instances[i];
	const struct scene_mesh *mesh = b->scene->meshes[in->mesh];
	const struct box *boxes = &b->boxes[b->first[in->mesh]];
	const uint32_t n_clusters = cluster_count(mesh);

	for (uint32_t k = next_cluster(r, boxes + n_clusters, 0, n_clusters); k < n_clusters && n < BLOCKERS_MOST;
	     k = next_cluster(r, boxes + n_clusters, k + 1, n_clusters)) {
		if (!meets_box(r, &boxes[k]))
			continue;
		for (uint32_t p = k * CLUSTER; p < (k + 1) * CLUSTER && p < mesh->primitive_count && n < BLOCKERS_MOST; p++) {
			float t = meet_triangle(r, corner_place(mesh, p, 0), corner_place(mesh, p, 1), corner_place(mesh, p, 2));

			if (t > 0)
				out[n++] = (struct blocker_hit){ t, i, side_met(b, in, p, r->d) };
		}
	}
	return n;
}

unsigned blockers_on(const struct blockers *b, uint32_t space, const float from[3], const float direction[3],
                     float t_max, struct blocker_hit out[BLOCKERS_MOST])
{
	const struct sight sight = sight_of(from, direction, t_max);
	unsigned n = 0;

	for (uint32_t i = 0; i < b->scene->n_instances && n < BLOCKERS_MOST; i++) {
		const float a[4] = { from[0], from[1], from[2], 1 }, d[4] = { direction[0], direction[1], direction[2], 0 };
		float origin[4], towards[4];
		struct line line = { .t_max = t_max };

		if (!b->blocks[i] || b->scene->views[b->scene->instances[i].view].space != space || !may_meet(&sight, &b->around[i]))
			continue;
		mat4_transform(origin, b->eye_inverse[i], a);
		mat4_transform(towards, b->eye_inverse[i], d);
		memcpy(line.from, origin, sizeof(line.from));
		memcpy(line.d, towards, sizeof(line.d));
		n = meet_instance(b, i, &line, out, n);
	}
	return n;
}
