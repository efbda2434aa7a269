#include "look/between/groups.h"

#include <stdlib.h>

#include "base/memory.h"
#include "base/table.h"

/* The draws of a frame, a linked list for each key. */
struct lists {
	struct table first; /* key -> instance + 1 */
	uint32_t *next;     /* [instances]: the next one, or SCENE_NONE */
};

/* List the draws of a frame by key. @return 0 or ERR_SYSTEM (reported) */
static int sort(const struct scene *s, groups_key *key_of, const void *with, struct lists *l)
{
	int err = 0;

	l->next = malloc((s->n_instances + (size_t)1) * sizeof(*l->next));
	if (!l->next)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = s->n_instances; i-- > 0 && !err;) {
		const uint64_t key = s->instances[i].rectangle ? 0 : key_of(s, i, with);

		if (!key)
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

/* The draws with a key. @return NULL: no memory (reported) */
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

static void free_group(struct group *g)
{
	free(g->members);
	free(g->rivals);
	free(g->is_taken);
}

/* Append the group of a key. @return 0 or ERR_SYSTEM (reported) */
static int add_group(struct groups *groups, const struct lists *own, const struct lists *others, uint64_t key)
{
	struct group g;

	g.members = take_list(own, key, &g.n);
	g.rivals = take_list(others, key, &g.n_rivals);
	g.is_taken = calloc(g.n_rivals + (size_t)1, 1);
	if (!g.members || !g.rivals || !g.is_taken || MEMORY_GROW(groups->all, groups->room, groups->n + 1)) {
		free_group(&g);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	groups->all[groups->n++] = g;
	return 0;
}

int groups_find(struct groups *groups, const struct bridge *b, groups_key *key, const void *with)
{
	struct lists own = { .next = NULL }, others = { .next = NULL };
	int err = sort(b->base, key, with, &own);

	if (!err)
		err = sort(b->other, key, with, &others);
	for (size_t k = 0; k < own.first.room && !err; k++)
		if (own.first.entries[k].value)
			err = add_group(groups, &own, &others, own.first.entries[k].key);
	free_lists(&own);
	free_lists(&others);
	return err;
}

void groups_free(struct groups *groups)
{
	for (uint32_t i = 0; i < groups->n; i++)
		free_group(&groups->all[i]);
	free(groups->all);
	*groups = (struct groups){ .all = NULL };
}

void group_couple(struct bridge *b, struct group *g, uint32_t member, uint32_t rival)
{
	b->couples[g->members[member]].other = g->rivals[rival];
	g->is_taken[rival] = 1;
	bridge_find_motion(b, g->members[member]);
}

int group_is_coupled(const struct bridge *b, const struct group *g, uint32_t member)
{
	return b->couples[g->members[member]].other != SCENE_NONE;
}

void group_part(struct bridge *b, uint32_t i)
{
	b->couples[i].other = SCENE_NONE;
	b->couples[i].is_sure = b->couples[i].moves = 0;
}
