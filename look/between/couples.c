/* Matches the draws of two frames, and finds the camera's motion. */
#include "look/between/couples.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "look/between/crowds.h"
#include "look/between/deforming.h"
#include "look/between/pose.h"
#include "look/draws/drawn.h"
#include "look/draws/followed.h"
#include "look/draws/matrix.h"
#include "scene/box.h"

/* --- The camera -------------------------------------------------------------------------------------------------- */

/* 1 if a draw counts when the camera's motion is sought: opaque triangles with depth, in perspective. */
static int votes(const struct bridge *b, uint32_t i)
{
	const struct scene *s = b->base;
	const struct scene_instance *in = &s->instances[i];
	const struct scene_material *m = &s->materials[in->material];

	return b->couples[i].moves && m->depth_test && m->depth_write && !m->blend &&
	       s->meshes[in->mesh]->kind == SCENE_TRIANGLES && !s->views[in->view].target &&
	       !drawn_in_parallel(&s->views[in->view]);
}

/* Collect the motions of draws that vote. @param only_sure  1: of sure couples only @return the sum of all sizes */
static double gather_motions(struct bridge *b, int only_sure)
{
	const struct scene *s = b->base;
	double all = 0;

	b->n_motions = 0;
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct couple *c = &b->couples[i];
		const uint32_t space = s->views[s->instances[i].view].space;
		unsigned g = 0;

		if (!votes(b, i) || c->is_sure < only_sure)
			continue;
		while (g < b->n_motions && (b->motions[g].space != space || !bridge_agrees(c, b->motions[g].motion, c->motion)))
			g++;
		all += c->size;
		if (g == BRIDGE_MOTIONS)
			continue;
		if (g == b->n_motions) {
			b->motions[b->n_motions++] = (struct motion){ .space = space };
			memcpy(b->motions[g].motion, c->motion, sizeof(c->motion));
		}
		b->motions[g].weight += c->size;
		for (struct motion swapped; g > 0 && b->motions[g - 1].weight < b->motions[g].weight; g--) {
			swapped = b->motions[g];
			b->motions[g] = b->motions[g - 1];
			b->motions[g - 1] = swapped;
		}
	}
	return all;
}

/* Find the camera's motion from sure draws or, if there are none, from all. */
static void find_camera(struct bridge *b)
{
	double all = gather_motions(b, 1), part[16];
	unsigned n = 0;

	if (!b->n_motions)
		all = gather_motions(b, 0);
	for (unsigned g = 0; g < b->n_motions; g++)
		if (matrix_invert(b->motions[g].back, b->motions[g].motion))
			b->motions[n++] = b->motions[g];
	b->n_motions = n;
	if (n && b->motions[0].weight > all / 2 && pose_part(part, b->motions[0].motion, 0.5))
		b->camera = &b->motions[0];
}

/* --- All draws --------------------------------------------------------------------------------------------------- */

/* Couple the n-th draw of a mesh with the n-th in the other frame. @return 0 or ERR_SYSTEM (reported) */
static int couple_by_number(struct bridge *b)
{
	const struct scene *s = b->base;
	struct followed sorted = { .by = { { 0 } } };
	uint32_t *found = malloc((s->n_instances + (size_t)1) * sizeof(*found));
	int err = found ? followed_note(&sorted, b->other) : err_report(ERR_SYSTEM, NULL, "out of memory");

	if (!err)
		err = followed_find(&sorted, s, found);
	for (uint32_t i = 0; i < s->n_meshes && !err; i++)
		scene_box(s->meshes[i], b->boxes[i][0], b->boxes[i][1]);
	for (uint32_t i = 0; i < s->n_instances && !err; i++) {
		b->couples[i].other = found[i] != SCENE_NONE && bridge_may_be_one(b, i, found[i]) ? found[i] : SCENE_NONE;
		if (b->couples[i].other != SCENE_NONE)
			bridge_find_motion(b, i);
	}
	free(found);
	followed_free(&sorted);
	return err;
}

/* 1 if a couple stands still or moves with the camera. */
static int is_still(const struct bridge *b, uint32_t i)
{
	const struct couple *c = &b->couples[i];

	return memcmp(bridge_place(b, i, 0), bridge_place(b, i, 1), 16 * sizeof(float)) == 0 ||
	       (c->moves && bridge_agrees(c, bridge_is_filmed(b, i) ? b->camera->motion : matrix_identity, c->motion));
}

/* Draws without depth that move, such as letters, lose their partner and keep the base's position: nothing proves which
 * is which. */
static void leave_flat(struct bridge *b)
{
	const struct scene *s = b->base;

	for (uint32_t i = 0; i < s->n_instances; i++)
		if (b->couples[i].other != SCENE_NONE && !s->materials[s->instances[i].material].depth_test && !is_still(b, i))
			b->couples[i].other = SCENE_NONE;
}

int couples_find(struct bridge *b, const struct scene *base, const struct scene *other, int is_back)
{
	struct groups crowds = { .all = NULL }, deforming = { .all = NULL };
	int err = 0;

	*b = (struct bridge){ .base = base, .other = other, .is_back = is_back };
	b->couples = calloc(base->n_instances + (size_t)1, sizeof(*b->couples));
	b->boxes = calloc(base->n_meshes + (size_t)1, sizeof(*b->boxes));
	b->motions = calloc(BRIDGE_MOTIONS, sizeof(*b->motions));
	if (!b->couples || !b->boxes || !b->motions)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	err = couple_by_number(b);
	if (!err)
		err = crowds_find(b, &crowds);
	if (!err)
		err = deforming_find(b, &deforming);
	if (!err) {
		find_camera(b);
		crowds_couple(b, &crowds);
		err = deforming_couple(b, &deforming);
	}
	groups_free(&crowds);
	groups_free(&deforming);
	if (err)
		return err;
	leave_flat(b);
	for (uint32_t i = 0; i < base->n_instances; i++) {
		b->n_matched += b->couples[i].other != SCENE_NONE;
		b->n_alone += b->couples[i].other == SCENE_NONE && !base->instances[i].rectangle;
	}
	return 0;
}
