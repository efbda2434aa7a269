#include "look/study/spared.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "look/spare/blockers.h"
#include "look/spare/spare.h"
#include "scene/depths.h"

enum { MOST_RULES = 256 };

/* Each draw decides alone which sides it shows (look/spare/sides.h), so frames do not vote on that. */
static const uint32_t bits[SPARED_BITS] = { SCENE_HIDDEN_FROM_LIGHTS, SCENE_STOPS_NO_SUN };

/* --- Votes ------------------------------------------------------------------------------------------------------- */

/* out: index + 1 of the entry */
static int vote(struct spared *s, const uint64_t hash[2], uint32_t is_texture, uint32_t lit, uint32_t spared,
                size_t *out)
{
	const uint64_t key = (hash[0] ^ (2 * is_texture + lit)) * 0x9e3779b97f4a7c15u;
	size_t at = (size_t)(uintptr_t)table_find(&s->by_key, key);
	struct spared_entry *e;

	if (!at) {
		if (MEMORY_GROW(s->entries, s->room, s->n + 1))
			return ERR_SYSTEM;
		s->entries[s->n] = (struct spared_entry){ .hash = { hash[0], hash[1] }, .is_texture = is_texture, .lit = lit };
		at = ++s->n;
		if (table_set(&s->by_key, key, (void *)(uintptr_t)at))
			return ERR_SYSTEM;
	}
	*out = at;
	e = &s->entries[at - 1];
	if (e->last == s->frames) {
		e->bits &= spared;
		return 0;
	}
	e->frames++;
	e->last = s->frames;
	e->bits = spared;
	return 0;
}

static void count_votes(struct spared *s)
{
	for (size_t i = 0; i < s->n; i++)
		for (int b = 0; b < SPARED_BITS; b++)
			s->entries[i].votes[b] += s->entries[i].last == s->frames && s->entries[i].bits & bits[b];
}

int spared_add(struct spared *s, const struct scene *scene)
{
	struct spare found;
	uint8_t *depths;
	int err = spare_find(scene, SPARE_TRICKS_KNOWN, &found);

	if (err || !found.n_lamps) {
		spare_free(&found);
		return err;
	}
	depths = calloc(scene->n_instances + (size_t)1, sizeof(*depths));
	if (!depths) {
		spare_free(&found);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	scene_find_depths(scene, depths);
	s->frames++;
	for (uint32_t i = 0; i < scene->n_instances && !err; i++) {
		const struct scene_material *m = &scene->materials[scene->instances[i].material];
		size_t mesh = 0, texture = 0;
		const uint32_t spared = found.bits ? found.bits[i] & (bits[0] | bits[1]) : 0, lit = m->lighting != 0;

		if (!blockers_can(scene, i, depths[i]))
			continue;
		s->any |= spared;
		err = vote(s, scene->meshes[scene->instances[i].mesh]->hash, 0, lit, spared, &mesh);
		if (!err && m->unit_count)
			err = vote(s, scene->textures[scene->units[m->unit_first].texture]->hash, 1, lit, spared, &texture);
		if (!err)
			s->entries[mesh - 1].texture = texture;
	}
	count_votes(s);
	free(depths);
	spare_free(&found);
	return err;
}

void spared_free(struct spared *s)
{
	free(s->entries);
	table_free(&s->by_key);
	*s = (struct spared){ .entries = NULL };
}

/* --- Rules ------------------------------------------------------------------------------------------------------- */

/* The decision of most frames. @param share  receives the share of frames that agree */
static uint32_t decide(const uint32_t votes[SPARED_BITS], uint32_t frames, double *share)
{
	uint32_t decided = 0, fewest = frames;

	for (int b = 0; b < SPARED_BITS; b++) {
		uint32_t agree = 2 * votes[b] > frames ? votes[b] : frames - votes[b];

		decided |= 2 * votes[b] > frames ? bits[b] : 0;
		fewest = agree < fewest ? agree : fewest;
	}
	*share = frames ? (double)fewest / frames : 0;
	return decided;
}

/* A rule to be added. */
struct rule {
	uint32_t decided, frames;
	double share;
};

static struct rule rule_of(const struct spared_entry *e)
{
	struct rule r = { .frames = e->frames };

	r.decided = decide(e->votes, e->frames, &r.share);
	return r;
}

/* The decision of most meshes of a kind, weighted by their frames. */
static struct rule rule_of_kind(const struct spared *s, uint32_t lit)
{
	uint32_t votes[SPARED_BITS] = { 0 };
	struct rule r = { .frames = 0 };

	for (size_t i = 0; i < s->n; i++) {
		if (s->entries[i].is_texture || s->entries[i].lit != lit)
			continue;
		r.frames += s->entries[i].frames;
		for (int b = 0; b < SPARED_BITS; b++)
			votes[b] += s->entries[i].votes[b];
	}
	r.decided = decide(votes, r.frames, &r.share);
	return r;
}

static void find_rule(const struct rule *r, uint32_t lit, const struct spared_entry *e, const char *of,
                      struct findings *out)
{
	struct finding *rule = findings_add(out, FINDINGS_SURFACES, r->decided ? "spared" : "blocker of light");

	finding_explain(rule, r->share * (1 - 0.5 / (1 + r->frames)), "in %.0f %% of %u %s it %s", 100 * r->share, r->frames,
	                of, r->decided ? "would shut out light of what OpenGL lights, or is beyond it" :
	                                 "is in the lit world and shuts out no light");
	if (e)
		FINDING_MATCH(rule, FINDING_HASHED(e->is_texture ? "texture" : "mesh", e->hash));
	FINDING_MATCH(rule, FINDING_IS("lit", lit));
	FINDING_SET(rule, FINDING_NAMED("passes", spare_name(r->decided | SCENE_ONE_SIDED)));
}

/* Rules for the meshes, or the textures, that differ from their kind. */
static void find_exceptions(const struct spared *s, uint32_t is_texture, struct findings *out)
{
	const struct rule kinds[2] = { rule_of_kind(s, 0), rule_of_kind(s, 1) };
	unsigned n = 0;

	for (size_t i = 0; i < s->n && n < MOST_RULES; i++) {
		const struct spared_entry *e = &s->entries[i];
		const struct rule r = rule_of(e), without = e->texture ? rule_of(&s->entries[e->texture - 1]) : kinds[e->lit];

		if (e->is_texture != is_texture || r.decided == without.decided || (e->frames < 2 && s->frames > 1 && !is_texture))
			continue;
		n++;
		find_rule(&r, e->lit, e, "frames", out);
	}
}

void spared_find(const struct spared *s, struct findings *out)
{
	if (!s->any)
		return;
	for (uint32_t lit = 0; lit < 2; lit++) {
		const struct rule r = rule_of_kind(s, lit);

		if (r.frames)
			find_rule(&r, lit, NULL, lit ? "cases that are lit" : "cases that are not lit", out);
	}
	find_exceptions(s, 1, out);
	find_exceptions(s, 0, out);
}
