#include "look/between/bridge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "look/between/pose.h"
#include "look/drawn.h"
#include "look/followed.h"
#include "look/matrix.h"

#define MOST_MOTIONS 64  /* different ones among which the camera's is looked for */
#define CROWD_WINDOW 64u /* most places that a draw is off in the order of its crowd */

/* --- Motions ----------------------------------------------------------------------------------------------------- */

const float *bridge_place(const struct bridge *b, uint32_t i, const struct scene *frame)
{
	const struct scene *s = b->mixer.base;

	return frame == s ? s->instances[i].modelview : b->mixer.other->instances[b->couples[i].other].modelview;
}

static void find_boxes(struct bridge *b)
{
	const struct scene *s = b->mixer.base;

	for (uint32_t i = 0; i < s->n_meshes; i++)
		for (int k = 0; k < 3; k++) {
			double low = INFINITY, high = -INFINITY;

			for (uint32_t v = 0; v < s->meshes[i]->vertex_count; v++) {
				low = fmin(low, (double)s->meshes[i]->position[4 * (size_t)v + (size_t)k]);
				high = fmax(high, (double)s->meshes[i]->position[4 * (size_t)v + (size_t)k]);
			}
			b->boxes[i][0][k] = low <= high ? low : 0;
			b->boxes[i][1][k] = low <= high ? high : 0;
		}
}

static void find_motion(struct bridge *b, uint32_t i)
{
	struct couple *c = &b->couples[i];
	const double (*box)[3] = (const double (*)[3])b->boxes[b->mixer.base->instances[i].mesh];
	double first[16], second[16], back[16], part[16], far = 0;

	matrix_from_floats(first, bridge_place(b, i, b->mixer.first));
	matrix_from_floats(second, bridge_place(b, i, b->mixer.second));
	for (int k = 0; k < 8; k++) {
		const double corner[4] = { box[k & 1][0], box[k >> 1 & 1][1], box[k >> 2][2], 1 };

		matrix_transform(c->corner[k], first, corner);
	}
	for (int k = 0; k < 3; k++)
		far = hypot(far, c->corner[7][k] - c->corner[0][k]);
	c->size = far;
	if (!matrix_invert(back, first))
		return;
	matrix_mul(c->motion, second, back);
	c->moves = pose_part(part, c->motion, 0.5);
}

/* 1 where two motions are the same to a draw. */
int bridge_agrees(const struct couple *c, const double a[16], const double b[16])
{
	for (int k = 0; k < 8; k++) {
		double p[4], q[4], off = 0, far = c->size;

		matrix_transform(p, a, c->corner[k]);
		matrix_transform(q, b, c->corner[k]);
		for (int i = 0; i < 3; i++) {
			off = fmax(off, fabs(p[i] - q[i]));
			far = fmax(far, fmax(fabs(c->corner[k][i]), fabs(p[i])));
		}
		if (!(off <= BRIDGE_SAME * far))
			return 0;
	}
	return 1;
}

/* --- The camera -------------------------------------------------------------------------------------------------- */

/* 1 if a draw helps to find how the camera moves: opaque, in depth and perspective. */
static int votes(const struct bridge *b, uint32_t i)
{
	const struct scene *s = b->mixer.base;
	const struct scene_instance *in = &s->instances[i];
	const struct scene_material *m = &s->materials[in->material];

	return b->couples[i].moves && m->depth_test && m->depth_write && !m->blend &&
	       s->meshes[in->mesh]->kind == SCENE_TRIANGLES && !s->views[in->view].target &&
	       !drawn_in_parallel(&s->views[in->view]);
}

struct group {
	const double *motion;
	double weight;
	uint32_t space;
};

static void find_camera(struct bridge *b)
{
	const struct scene *s = b->mixer.base;
	struct group groups[MOST_MOTIONS];
	unsigned n = 0, best = 0;
	double all = 0;

	b->space = SCENE_NONE;
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct couple *c = &b->couples[i];
		const uint32_t space = s->views[s->instances[i].view].space;
		unsigned g = 0;

		if (!votes(b, i))
			continue;
		while (g < n && (groups[g].space != space || !bridge_agrees(c, groups[g].motion, c->motion)))
			g++;
		all += c->size;
		if (g == MOST_MOTIONS)
			continue;
		if (g == n)
			groups[n++] = (struct group){ c->motion, 0, space };
		groups[g].weight += c->size;
		best = groups[g].weight > groups[best].weight ? g : best;
	}
	if (!n || !(groups[best].weight > all / 2) || !matrix_invert(b->back, groups[best].motion))
		return;
	memcpy(b->camera, groups[best].motion, sizeof(b->camera));
	if (!pose_part(b->mixer.camera_part, b->camera, b->mixer.at))
		return;
	b->space = groups[best].space;
	b->mixer.camera = b->camera;
}

/* 1 where a draw is seen by that camera. */
int bridge_is_filmed(const struct bridge *b, uint32_t i)
{
	const struct scene_view *view = &b->mixer.base->views[b->mixer.base->instances[i].view];

	return view->space == b->space && !view->target && !drawn_in_parallel(view);
}

/* 1 if two draws may show one thing. */
static int is_one(const struct bridge *b, uint32_t i, uint32_t other)
{
	const struct scene *s = b->mixer.base, *t = b->mixer.other;
	const struct scene_mesh *mesh = s->meshes[s->instances[i].mesh], *was = t->meshes[t->instances[other].mesh];
	const struct scene_view *view = &s->views[s->instances[i].view];

	if (view->target != t->views[t->instances[other].view].target)
		return 0;
	return mixed_same_points(mesh, was) ||
	       (s->materials[s->instances[i].material].depth_test && mixed_suits(mesh, was));
}

/* --- Crowds ------------------------------------------------------------------------------------------------------ */

/*
 * Many draws of the same points. A program may leave out one of them, and the n-th is another one then. Draws that do
 * not move on their own are found by the camera's motion; each of the others becomes the nearest that is left.
 */
struct crowd {
	uint32_t *rivals;  /* [n]: instances of the other frame that draw the same points, in order */
	uint8_t *is_taken; /* [n] */
	uint32_t n;
};

/* How far a draw of the other frame is from a draw of this one, once the camera has moved it. */
static double distance(const struct bridge *b, uint32_t i, uint32_t other)
{
	const double (*box)[3] = (const double (*)[3])b->boxes[b->mixer.base->instances[i].mesh];
	const double *camera = b->mixer.camera ? b->mixer.first == b->mixer.base ? b->camera : b->back : matrix_identity;
	double here[16], there[16], moved[16], off = 0, far = 0;

	matrix_from_floats(here, b->mixer.base->instances[i].modelview);
	matrix_from_floats(there, b->mixer.other->instances[other].modelview);
	if (bridge_is_filmed(b, i))
		matrix_mul(moved, camera, here);
	else
		memcpy(moved, here, sizeof(moved));
	for (int k = 0; k < 8; k += 1 + 2 * (k == 0) + (k == 3)) { /* 0, 3, 5, 6: those corners are no neighbours */
		const double corner[4] = { box[k & 1][0], box[k >> 1 & 1][1], box[k >> 2][2], 1 };
		double p[4], q[4];

		matrix_transform(p, moved, corner);
		matrix_transform(q, there, corner);
		for (int c = 0; c < 3; c++) {
			off = fmax(off, fabs(p[c] - q[c]));
			far = fmax(far, fabs(q[c]));
		}
	}
	return off <= BRIDGE_SAME * far ? 0 : off;
}

static int is_same_mesh(const struct bridge *b, uint32_t i, uint32_t other)
{
	const struct scene *s = b->mixer.base, *t = b->mixer.other;

	return memcmp(s->meshes[s->instances[i].mesh]->hash, t->meshes[t->instances[other].mesh]->hash,
	              sizeof(s->meshes[0]->hash)) == 0;
}

/*
 * The nearest free rival, up to `most` away, of a crowd's n-th draw; of several one of the same mesh. SCENE_NONE: there
 * is none
 */
static uint32_t nearest(const struct bridge *b, const struct crowd *c, uint32_t i, uint32_t n, double most)
{
	const uint32_t from = n > CROWD_WINDOW ? n - CROWD_WINDOW : 0;
	uint32_t best = SCENE_NONE;
	int is_same = 0;

	for (uint32_t k = from; k < c->n && k <= n + CROWD_WINDOW; k++) {
		const double off = c->is_taken[k] || !is_one(b, i, c->rivals[k]) ? INFINITY : distance(b, i, c->rivals[k]);
		const int same = off <= most && is_same_mesh(b, i, c->rivals[k]);

		if (off < INFINITY && off <= most && (best == SCENE_NONE || off < most || same > is_same)) {
			best = k;
			most = off;
			is_same = same;
		}
	}
	return best;
}

/* Couple draws of the same points. members: [n] of the nearer frame */
static void couple_crowd(struct bridge *b, struct crowd *c, const uint32_t *members, uint32_t n)
{
	for (int pass = 0; pass < 2; pass++) /* draws without a motion of their own first */
		for (uint32_t k = 0; k < n; k++) {
			struct couple *couple = &b->couples[members[k]];
			uint32_t best;

			if (pass && couple->other != SCENE_NONE)
				continue;
			best = nearest(b, c, members[k], k, pass ? INFINITY : 0);
			couple->other = best == SCENE_NONE ? SCENE_NONE : c->rivals[best];
			if (best != SCENE_NONE)
				c->is_taken[best] = 1;
		}
}

/* A frame's instances, sorted by points: key -> the first + 1, and the next of each. */
struct lists {
	struct table first;
	uint32_t *next; /* [instances], or SCENE_NONE */
};

/* @return 0 or ERR_SYSTEM (reported) */
static int list_points(const struct scene *s, struct lists *l)
{
	int err = 0;

	l->next = malloc((s->n_instances + (size_t)1) * sizeof(*l->next));
	if (!l->next)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = s->n_instances; i-- > 0 && !err;) {
		const uint64_t key = followed_points(s->meshes[s->instances[i].mesh]);

		if (s->instances[i].rectangle)
			continue;
		l->next[i] = (uint32_t)((uintptr_t)table_find(&l->first, key) - 1);
		err = table_set(&l->first, key, (void *)((uintptr_t)i + 1));
	}
	return err;
}

/* The instances of a list, into out. @return how many */
static uint32_t take_list(const struct lists *l, uint64_t key, uint32_t *out)
{
	uint32_t n = 0;

	for (uint32_t i = (uint32_t)((uintptr_t)table_find(&l->first, key) - 1); i != SCENE_NONE; i = l->next[i])
		out[n++] = i;
	return n;
}

/* @return 0 or ERR_SYSTEM (reported) */
static int couple_crowds(struct bridge *b)
{
	const struct scene *s = b->mixer.base, *other = b->mixer.other;
	struct lists own = { .next = NULL }, others = { .next = NULL };
	uint32_t *members = malloc((s->n_instances + (size_t)1) * sizeof(*members));
	struct crowd c = { malloc((other->n_instances + (size_t)1) * sizeof(*c.rivals)), malloc(other->n_instances + 1), 0 };
	int err = members && c.rivals && c.is_taken ? list_points(s, &own) : err_report(ERR_SYSTEM, NULL, "out of memory");

	if (!err)
		err = list_points(other, &others);
	for (size_t k = 0; k < own.first.room && !err; k++) {
		const uint32_t n = own.first.entries[k].value ? take_list(&own, own.first.entries[k].key, members) : 0;

		c.n = n ? take_list(&others, own.first.entries[k].key, c.rivals) : 0;
		if (!c.n || (n == 1 && c.n == 1))
			continue;
		memset(c.is_taken, 0, c.n);
		couple_crowd(b, &c, members, n);
		for (uint32_t i = 0; i < n; i++) {
			b->couples[members[i]].moves = 0;
			if (b->couples[members[i]].other != SCENE_NONE)
				find_motion(b, members[i]);
		}
	}
	free(members);
	free(c.rivals);
	free(c.is_taken);
	free(own.next);
	free(others.next);
	table_free(&own.first);
	table_free(&others.first);
	return err;
}

/* --- All together ------------------------------------------------------------------------------------------------ */

/* @return 0 or ERR_SYSTEM (reported) */
static int couple_by_number(struct bridge *b)
{
	const struct scene *s = b->mixer.base;
	struct followed sorted = { .by = { { 0 } } };
	uint32_t *found = malloc((s->n_instances + (size_t)1) * sizeof(*found));
	int err = found ? followed_note(&sorted, b->mixer.other) : err_report(ERR_SYSTEM, NULL, "out of memory");

	if (!err)
		err = followed_find(&sorted, s, found);
	if (!err)
		find_boxes(b);
	for (uint32_t i = 0; i < s->n_instances && !err; i++) {
		b->couples[i].other = found[i] != SCENE_NONE && is_one(b, i, found[i]) ? found[i] : SCENE_NONE;
		if (b->couples[i].other != SCENE_NONE)
			find_motion(b, i);
	}
	free(found);
	followed_free(&sorted);
	return err;
}

/* 1 if a couple does not move, or goes with the camera. */
static int is_still(const struct bridge *b, uint32_t i)
{
	const struct couple *c = &b->couples[i];

	return memcmp(bridge_place(b, i, b->mixer.first), bridge_place(b, i, b->mixer.second), 16 * sizeof(float)) == 0 ||
	       (c->moves && bridge_agrees(c, bridge_is_filmed(b, i) ? b->camera : matrix_identity, c->motion));
}

/* Draws without depth, such as letters, keep the nearer frame's place if they move: no evidence says which is which. */
static void leave_flat(struct bridge *b)
{
	const struct scene *s = b->mixer.base;

	for (uint32_t i = 0; i < s->n_instances; i++)
		if (b->couples[i].other != SCENE_NONE && !s->materials[s->instances[i].material].depth_test && !is_still(b, i))
			b->couples[i].other = SCENE_NONE;
}

int bridge_couple(struct bridge *b)
{
	int err = couple_by_number(b);

	if (!err)
		find_camera(b);
	if (!err)
		err = couple_crowds(b);
	if (!err)
		leave_flat(b);
	return err;
}
