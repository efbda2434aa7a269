#include "look/between/crowds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "look/followed.h"
#include "look/matrix.h"

#define WINDOW 64u       /* places in its crowd that a draw may be off */
#define MOST_MOTIONS 9u  /* are tried, standing still among them */
#define SAME_SHAPE 1e-3  /* times a shape's size squared */

struct crowd {
	uint32_t *members, *rivals; /* [n], [n_rivals]: instances of the base and of the other frame, in order */
	uint8_t *is_taken;          /* [n_rivals] */
	uint32_t n, n_rivals;
};

struct crowds {
	struct crowd *all;
	uint32_t n, room;
};

/* --- Who is in a crowd ------------------------------------------------------------------------------------------- */

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

static void free_lists(struct lists *l)
{
	table_free(&l->first);
	free(l->next);
}

/* The instances of a list. @return NULL: no memory (reported) */
static uint32_t *take_list(const struct lists *l, uint64_t key, uint32_t *n)
{
	const uint32_t first = (uint32_t)((uintptr_t)table_find(&l->first, key) - 1);
	uint32_t *out, k = 0;

	for (uint32_t i = first; i != SCENE_NONE; i = l->next[i])
		k++;
	out = malloc((k + (size_t)1) * sizeof(*out));
	*n = k;
	k = 0;
	for (uint32_t i = first; out && i != SCENE_NONE; i = l->next[i])
		out[k++] = i;
	if (!out)
		err_report(ERR_SYSTEM, NULL, "out of memory");
	return out;
}

static void free_crowd(struct crowd *c)
{
	free(c->members);
	free(c->rivals);
	free(c->is_taken);
}

/* @return 0 or ERR_SYSTEM (reported) */
static int add_crowd(struct crowds *crowds, const struct lists *own, const struct lists *others, uint64_t key)
{
	struct crowd c;

	c.members = take_list(own, key, &c.n);
	c.rivals = take_list(others, key, &c.n_rivals);
	c.is_taken = calloc(c.n_rivals + (size_t)1, 1);
	if (!c.members || !c.rivals || !c.is_taken || MEMORY_GROW(crowds->all, crowds->room, crowds->n + 1)) {
		free_crowd(&c);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	if (c.n_rivals && c.n + c.n_rivals > 2)
		crowds->all[crowds->n++] = c;
	else
		free_crowd(&c);
	return 0;
}

/* --- Shapes ------------------------------------------------------------------------------------------------------ */

/* The products of a modelview's columns: no motion changes them. */
static void shape_of(const float m[16], double out[6])
{
	for (int k = 0, i = 0; i < 3; i++)
		for (int j = 0; j <= i; j++, k++) {
			out[k] = 0;
			for (int row = 0; row < 3; row++)
				out[k] += (double)m[4 * i + row] * (double)m[4 * j + row];
		}
}

static int has_shape(const struct scene *s, uint32_t instance, const double shape[6])
{
	double own[6], off = 0;

	shape_of(s->instances[instance].modelview, own);
	for (int k = 0; k < 6; k++)
		off = fmax(off, fabs(own[k] - shape[k]));
	return off <= SAME_SHAPE * (shape[0] + shape[2] + shape[5]);
}

static void couple(struct bridge *b, struct crowd *c, uint32_t member, uint32_t rival)
{
	b->couples[c->members[member]].other = c->rivals[rival];
	c->is_taken[rival] = 1;
	bridge_find_motion(b, c->members[member]);
}

static int is_coupled(const struct bridge *b, const struct crowd *c, uint32_t member)
{
	return b->couples[c->members[member]].other != SCENE_NONE;
}

/* Stage 1. */
static void single_out(struct bridge *b, struct crowd *c)
{
	for (uint32_t k = 0; k < c->n; k++) {
		struct couple *one = &b->couples[c->members[k]];
		uint32_t n = 0, n_rivals = 0, rival = 0;
		double shape[6];

		one->other = SCENE_NONE;
		one->is_sure = one->moves = 0;
		shape_of(b->base->instances[c->members[k]].modelview, shape);
		for (uint32_t i = 0; i < c->n && n < 2; i++)
			n += (uint32_t)has_shape(b->base, c->members[i], shape);
		for (uint32_t i = 0; i < c->n_rivals && n == 1 && n_rivals < 2; i++)
			if (has_shape(b->other, c->rivals[i], shape) && bridge_may_be_one(b, c->members[k], c->rivals[i])) {
				rival = i;
				n_rivals++;
			}
		if (n_rivals != 1)
			continue;
		couple(b, c, k, rival);
		one->is_sure = 1;
	}
}

int crowds_find(struct bridge *b, struct crowds **out)
{
	struct lists own = { .next = NULL }, others = { .next = NULL };
	struct crowds *crowds = calloc(1, sizeof(*crowds));
	int err = crowds ? list_points(b->base, &own) : err_report(ERR_SYSTEM, NULL, "out of memory");

	*out = crowds;
	if (!err)
		err = list_points(b->other, &others);
	for (size_t k = 0; k < own.first.room && !err; k++)
		if (own.first.entries[k].value)
			err = add_crowd(crowds, &own, &others, own.first.entries[k].key);
	free_lists(&own);
	free_lists(&others);
	for (uint32_t i = 0; i < b->base->n_instances; i++)
		b->couples[i].is_sure = 1;
	for (uint32_t i = 0; !err && i < crowds->n; i++)
		single_out(b, &crowds->all[i]);
	return err;
}

/* --- The others -------------------------------------------------------------------------------------------------- */

/* How far a rival is from where a motion takes a draw. NULL: it stays */
static double distance(const struct bridge *b, uint32_t i, uint32_t other, const double *motion)
{
	double here[16], there[16], moved[16], off = 0, far = 0;

	matrix_from_floats(here, b->base->instances[i].modelview);
	matrix_from_floats(there, b->other->instances[other].modelview);
	if (motion)
		matrix_mul(moved, motion, here);
	else
		memcpy(moved, here, sizeof(moved));
	for (int k = 0; k < 8; k += 1 + 2 * (k == 0) + (k == 3)) { /* 0, 3, 5, 6: those corners are no neighbours */
		double corner[4], p[4], q[4];

		bridge_corner(b, i, k, corner);
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
	const struct scene *s = b->base, *t = b->other;

	return memcmp(s->meshes[s->instances[i].mesh]->hash, t->meshes[t->instances[other].mesh]->hash,
	              sizeof(s->meshes[0]->hash)) == 0;
}

/*
 * The nearest free rival of a member, up to `most` away from where a motion takes it; of several one of the same mesh.
 * is_shaped: 1: of the same shape alone. SCENE_NONE: there is none
 */
static uint32_t nearest(const struct bridge *b, const struct crowd *c, uint32_t member, const double *motion,
                        double most, int is_shaped)
{
	const uint32_t from = member > WINDOW ? member - WINDOW : 0, i = c->members[member];
	uint32_t best = SCENE_NONE;
	double shape[6];
	int is_same = 0;

	shape_of(b->base->instances[i].modelview, shape);
	for (uint32_t k = from; k < c->n_rivals && k <= member + WINDOW; k++) {
		const uint32_t other = c->rivals[k];
		double off;
		int same;

		if (c->is_taken[k] || (is_shaped && !has_shape(b->other, other, shape)) || !bridge_may_be_one(b, i, other))
			continue;
		off = distance(b, i, other, motion);
		same = off <= most && is_same_mesh(b, i, other);
		if (off < INFINITY && off <= most && (best == SCENE_NONE || off < most || same > is_same)) {
			best = k;
			most = off;
			is_same = same;
		}
	}
	return best;
}

static const double *way(const struct bridge *b, const struct motion *m)
{
	return b->is_back ? m->back : m->motion;
}

/* Stage 2. */
static void couple_by_motions(struct bridge *b, struct crowd *c)
{
	for (unsigned g = 0; g < b->n_motions + 1 && g < MOST_MOTIONS; g++)
		for (uint32_t k = 0; k < c->n; k++) {
			const struct scene_view *view = &b->base->views[b->base->instances[c->members[k]].view];
			const int is_still = g == b->n_motions || g + 1 == MOST_MOTIONS; /* at last those that do not move */
			uint32_t rival;

			if (is_coupled(b, c, k) || (!is_still && view->space != b->motions[g].space))
				continue;
			rival = nearest(b, c, k, is_still ? NULL : way(b, &b->motions[g]), 0, 1);
			if (rival != SCENE_NONE)
				couple(b, c, k, rival);
		}
}

/* 1 if nothing speaks against the n-th being the n-th. */
static int keeps_order(const struct bridge *b, const struct crowd *c)
{
	uint32_t k = 0;

	while (k < c->n && (!is_coupled(b, c, k) || b->couples[c->members[k]].other == c->rivals[k]))
		k++;
	return c->n == c->n_rivals && k == c->n;
}

/* Stage 3. */
static void couple_rest(struct bridge *b, struct crowd *c)
{
	const int keeps = keeps_order(b, c);

	for (uint32_t k = 0; k < c->n && keeps; k++)
		if (!is_coupled(b, c, k) && bridge_may_be_one(b, c->members[k], c->rivals[k]))
			couple(b, c, k, k);
	for (int is_shaped = 1; is_shaped >= 0; is_shaped--)
		for (uint32_t k = 0; k < c->n; k++) {
			uint32_t rival;

			if (is_coupled(b, c, k))
				continue;
			rival = nearest(b, c, k, bridge_is_filmed(b, c->members[k]) ? way(b, b->camera) : NULL, INFINITY, is_shaped);
			if (rival != SCENE_NONE)
				couple(b, c, k, rival);
		}
}

void crowds_couple(struct bridge *b, const struct crowds *crowds)
{
	for (uint32_t i = 0; i < crowds->n; i++) {
		couple_by_motions(b, &crowds->all[i]);
		couple_rest(b, &crowds->all[i]);
	}
}

void crowds_free(struct crowds **crowds)
{
	for (uint32_t i = 0; *crowds && i < (*crowds)->n; i++)
		free_crowd(&(*crowds)->all[i]);
	if (*crowds)
		free((*crowds)->all);
	free(*crowds);
	*crowds = NULL;
}
