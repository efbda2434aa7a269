#include "look/study/roles/kinds.h"

#include <stdlib.h>

#include "base/memory.h"
#include "look/draws/drawn.h"
#include "look/study/roles/laid.h"
#include "look/study/roles/layer.h"

enum { BY_MESH, BY_TEXTURE, BY_STATE };
enum {
	STATE_LIT = 1, STATE_BLENDED = 2, STATE_ALPHA = 4, STATE_DEPTH = 8, STATE_STENCIL = 16, STATE_MULTIPLIES = 32,
	STATE_PARALLEL = 64, STATE_UNITS = 128
};
/* Each mesh is tested for what it lies on at most MOST_IN_FRAME times in a frame and MOST_VOTES times in all. A role
 * has at most MOST_RULES rules. */
enum { MOST_IN_FRAME = 4, MOST_VOTES = 48, MOST_RULES = 64 };
/* A kind has a role if at least this share of its draws have it. */
#define SHARE 0.95

/* --- Votes ------------------------------------------------------------------------------------------------------- */

static uint64_t state_of(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];
	uint64_t state = m->unit_count * STATE_UNITS;

	state |= (m->lighting ? STATE_LIT : 0) | (m->blend ? STATE_BLENDED : 0) | (m->alpha_test ? STATE_ALPHA : 0);
	state |= (m->depth_test ? STATE_DEPTH : 0) | (m->stencil_test ? STATE_STENCIL : 0) |
	         (drawn_multiplies(m) ? STATE_MULTIPLIES : 0);
	return state | (drawn_in_parallel(&s->views[in->view]) ? STATE_PARALLEL : 0);
}

static uint64_t key_of(const uint64_t hash[2], uint32_t by)
{
	return (hash[0] ^ (hash[1] << 1) ^ by) * 0x9e3779b97f4a7c15u;
}

/* @return index + 1; 0: out of memory (reported) */
static size_t find_kind(struct kinds *k, const uint64_t hash[2], uint32_t by)
{
	const uint64_t key = key_of(hash, by);
	size_t at = (size_t)(uintptr_t)table_find(&k->by_key, key);

	if (at)
		return at;
	if (MEMORY_GROW(k->list, k->room, k->n + 1) || table_set(&k->by_key, key, (void *)(uintptr_t)(k->n + 1)))
		return 0;
	k->list[k->n] = (struct kind){ .hash = { hash[0], hash[1] }, .by = by };
	return ++k->n;
}

static void note_frame(struct kinds *k, struct kind *kind)
{
	kind->frames += kind->last != k->frames;
	kind->last = k->frames;
}

static int vote(struct kinds *k, const uint64_t hash[2], uint32_t by, enum kind_role role, size_t *at)
{
	*at = find_kind(k, hash, by);
	if (!*at)
		return ERR_SYSTEM;
	note_frame(k, &k->list[*at - 1]);
	k->list[*at - 1].draws[role]++;
	return 0;
}

/* A draw votes for its mesh, its last texture and its state. Its earlier textures count as part of the world, since
 * other draws share them. */
static int vote_all(struct kinds *k, const struct scene *s, const struct scene_instance *in, enum kind_role role)
{
	const struct scene_material *m = &s->materials[in->material];
	const uint64_t state[2] = { state_of(s, in), 0 };
	size_t mesh = 0, texture = 0, by_state = 0;
	int err = vote(k, s->meshes[in->mesh]->hash, BY_MESH, role, &mesh);

	for (uint32_t u = 0; u < m->unit_count && !err; u++)
		err = vote(k, s->textures[s->units[m->unit_first + u].texture]->hash, BY_TEXTURE,
		           u + 1 < m->unit_count ? KIND_WORLD : role, &texture);
	if (!err)
		err = vote(k, state, BY_STATE, role, &by_state);
	if (err)
		return err;
	k->list[mesh - 1].texture = texture;
	k->list[mesh - 1].state = by_state;
	return 0;
}

static uint32_t votes_of(const struct kind *k)
{
	uint32_t n = 0;

	for (int r = 0; r < N_KIND_ROLES; r++)
		n += k->draws[r];
	return n;
}

/* Candidates for laid_find that have not been tested often enough: out[i] is LAID_DECAL for these, LAID_NOT for the
 * rest. */
static int list_candidates(struct kinds *k, const struct scene *s, const uint8_t *layers, uint8_t *out)
{
	for (uint32_t i = 0; i < s->n_instances; i++) {
		struct kind *kind;
		size_t mesh;

		out[i] = LAID_NOT;
		if (layers[i] != LAYER_WORLD || !laid_may_be(s, i))
			continue;
		mesh = find_kind(k, s->meshes[s->instances[i].mesh]->hash, BY_MESH);
		if (!mesh)
			return ERR_SYSTEM;
		kind = &k->list[mesh - 1];
		if (kind->last != k->frames)
			kind->asked = 0;
		note_frame(k, kind);
		if (kind->asked < MOST_IN_FRAME && votes_of(kind) + kind->asked < MOST_VOTES) {
			kind->asked++;
			out[i] = LAID_DECAL;
		}
	}
	return 0;
}

int kinds_add(struct kinds *k, const struct scene *s)
{
	static const enum kind_role roles[] = { KIND_WORLD, KIND_DECAL, KIND_SHADOW, KIND_LIT_SHADOW };
	uint8_t *laid = malloc(s->n_instances + (size_t)1), *asked = malloc(s->n_instances + (size_t)1);
	int err = laid && asked ? MEMORY_GROW(k->layers, k->room_layers, s->n_instances + (size_t)1) :
	                          err_report(ERR_SYSTEM, NULL, "out of memory");
	const uint8_t *layers = k->layers;

	k->frames++;
	if (!err) {
		layer_find(s, k->layers);
		err = list_candidates(k, s, layers, laid);
	}
	for (uint32_t i = 0; i < s->n_instances && !err; i++)
		asked[i] = laid[i] != LAID_NOT || (!laid_may_be(s, i) && !drawn_in_parallel(&s->views[s->instances[i].view]));
	if (!err)
		err = laid_find(s, laid);
	for (uint32_t i = 0; i < s->n_instances && !err; i++)
		if (layers[i] == LAYER_SKY)
			err = vote_all(k, s, &s->instances[i], KIND_SKY);
		else if (layers[i] == LAYER_WORLD && asked[i] && laid[i] != LAID_UNKNOWN)
			err = vote_all(k, s, &s->instances[i], roles[laid[i]]);
	free(laid);
	free(asked);
	return err;
}

void kinds_free(struct kinds *k)
{
	free(k->list);
	free(k->layers);
	table_free(&k->by_key);
	*k = (struct kinds){ .list = NULL };
}

/* --- Rules ------------------------------------------------------------------------------------------------------- */

/* A role and its rule. */
struct rule {
	const char *role, *why;
	struct finding_value sets[3];
	uint32_t roles; /* bits of enum kind_role; any of them suffices */
	uint32_t when;  /* bit 0: applies where unlit surfaces stay unlit; bit 1: where other lights light them */
};

#define KEEPS_LIGHT { FINDING_IS("shadows", 0), FINDING_IS("shaded", 0) }
#define NO_SHADOW { FINDING_IS("shadows", 0) }
#define IS_REPLACED { FINDING_IS("shadows", 0), FINDING_IS("mirrors", 0), FINDING_IS("left_out", 1) }
#define STAYS { FINDING_IS("shadows", 0), FINDING_IS("dome", 0) }

static const struct rule rules[] = {
	{ "sky", "are painted before the world, hide nothing of it, and are all around", KEEPS_LIGHT,
	  1u << KIND_SKY, 3 },
	{ "decal", "lie on what was drawn before them", NO_SHADOW, 1u << KIND_DECAL, 3 },
	{ "blob shadow",
	  "darken what they lie on, below a thing on it; traced shadows of OpenGL's lights replace them",
	  IS_REPLACED, 1u << KIND_LIT_SHADOW, 3 },
	{ "blob shadow",
	  "darken what they lie on, below a thing on it; no light of OpenGL's does, and so they stay",
	  STAYS, 1u << KIND_SHADOW, 1 },
	{ "blob shadow",
	  "darken what they lie on, below a thing on it; traced shadows of the lights below replace them",
	  IS_REPLACED, 1u << KIND_SHADOW, 2 },
};

enum { N_RULES = sizeof(rules) / sizeof(rules[0]) };

static uint32_t draws_with(const struct kind *k, uint32_t roles)
{
	uint32_t n = 0;

	for (int r = 0; r < N_KIND_ROLES; r++)
		n += roles >> r & 1 ? k->draws[r] : 0;
	return n;
}

static int has(const struct kind *k, uint32_t roles)
{
	const uint32_t with = draws_with(k, roles);

	return with && with >= SHARE * votes_of(k);
}

/* 1 if a rule for a mesh's texture or state already covers the mesh. */
static int is_said(const struct kinds *k, const struct kind *mesh, uint32_t roles)
{
	return (mesh->texture && has(&k->list[mesh->texture - 1], roles)) ||
	       (mesh->state && has(&k->list[mesh->state - 1], roles) && mesh->frames == 1 && k->frames > 1);
}

/* 1 if a state needs its own rule: a mesh that occurs in one frame only has it, and no texture covers that mesh. */
static int is_needed(const struct kinds *k, size_t state, uint32_t roles)
{
	for (size_t i = 0; i < k->n && k->frames > 1; i++) {
		const struct kind *mesh = &k->list[i];

		if (mesh->by == BY_MESH && mesh->state == state + 1 && mesh->frames == 1 && has(mesh, roles) &&
		    !(mesh->texture && has(&k->list[mesh->texture - 1], roles)))
			return 1;
	}
	return 0;
}

/* Match the draws of a kind. Rules for decals and shadows skip draws in parallel projection; a state names the
 * projection itself. */
static void match_kind(const struct kind *k, const struct rule *r, struct finding *out)
{
	const uint64_t s = k->hash[0];

	if (k->by == BY_STATE) {
		FINDING_MATCH(out, FINDING_IS("lit", s & STATE_LIT), FINDING_COUNTED("units", s / STATE_UNITS),
		              FINDING_IS("blended", s & STATE_BLENDED), FINDING_IS("alpha_tested", s & STATE_ALPHA),
		              FINDING_IS("depth_tested", s & STATE_DEPTH), FINDING_IS("stencil_tested", s & STATE_STENCIL),
		              FINDING_IS("multiplies", s & STATE_MULTIPLIES), FINDING_IS("parallel", s & STATE_PARALLEL));
		return;
	}
	FINDING_MATCH(out, FINDING_HASHED(k->by == BY_MESH ? "mesh" : "texture", k->hash));
	if (r->roles != 1u << KIND_SKY)
		FINDING_MATCH(out, FINDING_IS("parallel", 0));
}

static int is_found(const struct kinds *k, size_t i, uint32_t roles)
{
	const struct kind *kind = &k->list[i];

	if (!has(kind, roles) || (kind->frames < 2 && k->frames > 1 && kind->by == BY_MESH))
		return 0;
	return kind->by == BY_MESH ? !is_said(k, kind, roles) : kind->by == BY_TEXTURE || is_needed(k, i, roles);
}

void kinds_find(const struct kinds *k, int is_relit, struct findings *out)
{
	for (int r = 0; r < N_RULES; r++) {
		unsigned n = 0;

		for (size_t i = 0; i < k->n && n < MOST_RULES; i++) {
			const struct kind *kind = &k->list[i];
			const uint32_t with = draws_with(kind, rules[r].roles);
			struct finding *rule;

			if (!(rules[r].when >> is_relit & 1) || !is_found(k, i, rules[r].roles))
				continue;
			n++;
			rule = findings_add(out, FINDINGS_SURFACES, "%s", rules[r].role);
			finding_explain(rule, with * (1 - 0.5 / (1 + kind->frames)) / votes_of(kind),
			                "%u of %u draws in %u frames %s", with, votes_of(kind), kind->frames, rules[r].why);
			match_kind(kind, &rules[r], rule);
			finding_set(rule, rules[r].sets, sizeof(rules[r].sets) / sizeof(rules[r].sets[0]));
		}
	}
}

int kinds_has_sky(const struct kinds *k, const uint64_t mesh[2])
{
	const size_t at = (size_t)(uintptr_t)table_find(&k->by_key, key_of(mesh, BY_MESH));

	return at && (has(&k->list[at - 1], 1u << KIND_SKY) || is_said(k, &k->list[at - 1], 1u << KIND_SKY));
}
