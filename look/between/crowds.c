/* Matches draws of the same points, in the three stages of crowds.h. */
#include "look/between/crowds.h"

#include <math.h>
#include <string.h>

#include "base/err.h"
#include "look/between/place.h"
#include "look/draws/followed.h"
#include "look/draws/matrix.h"

#define WINDOW 64u       /* largest difference between the partners' positions in their crowd */
#define MOST_MOTIONS 9u  /* motions that stage 2 tries; the last is standing still */
#define SAME_SHAPE 1e-3  /* relative to a shape's size squared */

static uint64_t key_of(const struct scene *s, uint32_t instance, const void *with)
{
	const uint64_t key = followed_points(s->meshes[s->instances[instance].mesh]);

	(void)with;
	return key ? key : 1;
}

static int is_crowd(const struct group *g)
{
	return g->n_rivals && g->n + g->n_rivals > 2;
}

/* --- Shapes ------------------------------------------------------------------------------------------------------ */

/* The dot products of a modelview's first three columns, which rigid motions do not change. */
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

/* Stage 1: couple draws whose shape no other draw of the crowd has, in either frame. */
static void single_out(struct bridge *b, struct group *c)
{
	for (uint32_t k = 0; k < c->n; k++) {
		struct couple *one = &b->couples[c->members[k]];
		uint32_t n = 0, n_rivals = 0, rival = 0;
		double shape[6];

		group_part(b, c->members[k]);
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
		group_couple(b, c, k, rival);
		one->is_sure = 1;
	}
}

int crowds_find(struct bridge *b, struct groups *crowds)
{
	if (groups_find(crowds, b, key_of, NULL))
		return ERR_SYSTEM;
	for (uint32_t i = 0; i < b->base->n_instances; i++)
		b->couples[i].is_sure = 1;
	for (uint32_t i = 0; i < crowds->n; i++)
		if (is_crowd(&crowds->all[i]))
			single_out(b, &crowds->all[i]);
	return 0;
}

/* --- Stages 2 and 3 ---------------------------------------------------------------------------------------------- */

/* The distance of a rival from where a motion takes a draw. @param motion  NULL: the draw stays */
static double distance(const struct bridge *b, uint32_t i, uint32_t other, const double *motion)
{
	double here[16], there[16], moved[16], off = 0, far = 0;

	matrix_from_floats(here, b->base->instances[i].modelview);
	matrix_from_floats(there, b->other->instances[other].modelview);
	if (motion)
		matrix_mul(moved, motion, here);
	else
		memcpy(moved, here, sizeof(moved));
	for (int k = 0; k < 8; k += 1 + 2 * (k == 0) + (k == 3)) { /* corners 0, 3, 5 and 6 are not adjacent */
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
 * The nearest free rival of a member, at most `most` from where a motion takes the member; among equals, one with the
 * same mesh.
 * @param is_shaped  1: only rivals of the same shape
 * @return SCENE_NONE: there is none
 */
static uint32_t nearest(const struct bridge *b, const struct group *c, uint32_t member, const double *motion,
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

/* Stage 2: couple members with the rival that a known motion takes them to; standing still is the last motion tried. */
static void couple_by_motions(struct bridge *b, struct group *c)
{
	for (unsigned g = 0; g < b->n_motions + 1 && g < MOST_MOTIONS; g++)
		for (uint32_t k = 0; k < c->n; k++) {
			const struct scene_view *view = &b->base->views[b->base->instances[c->members[k]].view];
			const int is_still = g == b->n_motions || g + 1 == MOST_MOTIONS;
			uint32_t rival;

			if (group_is_coupled(b, c, k) || (!is_still && view->space != b->motions[g].space))
				continue;
			rival = nearest(b, c, k, is_still ? NULL : bridge_way(b, &b->motions[g]), 0, 1);
			if (rival != SCENE_NONE)
				group_couple(b, c, k, rival);
		}
}

/* 1 if both frames have the same number, and every couple so far joins the n-th with the n-th. */
static int keeps_order(const struct bridge *b, const struct group *c)
{
	uint32_t k = 0;

	while (k < c->n && (!group_is_coupled(b, c, k) || b->couples[c->members[k]].other == c->rivals[k]))
		k++;
	return c->n == c->n_rivals && k == c->n;
}

static double size_of(const struct bridge *b, uint32_t i)
{
	const struct scene_instance *in = &b->base->instances[i];
	struct place place;

	place_find(in, (const float (*)[3])b->boxes[in->mesh], NULL, &place);
	return place.size;
}

/* Stage 3: couple the rest, in order if that contradicts nothing, otherwise with the nearest. */
static void couple_rest(struct bridge *b, struct group *c)
{
	const int keeps = keeps_order(b, c);

	for (uint32_t k = 0; k < c->n && keeps; k++)
		if (!group_is_coupled(b, c, k) && bridge_may_be_one(b, c->members[k], c->rivals[k]))
			group_couple(b, c, k, k);
	for (int is_shaped = 1; is_shaped >= 0; is_shaped--)
		for (uint32_t k = 0; k < c->n; k++) {
			const uint32_t i = c->members[k];
			double most = INFINITY;
			uint32_t rival;

			if (group_is_coupled(b, c, k))
				continue;
			if (!keeps)
				most = size_of(b, i);
			rival = nearest(b, c, k, bridge_is_filmed(b, i) ? bridge_way(b, b->camera) : NULL, most, is_shaped);
			if (rival != SCENE_NONE)
				group_couple(b, c, k, rival);
		}
}

void crowds_couple(struct bridge *b, const struct groups *crowds)
{
	for (uint32_t i = 0; i < crowds->n; i++)
		if (is_crowd(&crowds->all[i])) {
			couple_by_motions(b, &crowds->all[i]);
			couple_rest(b, &crowds->all[i]);
		}
}
