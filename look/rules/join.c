#include "look/rules/join.h"

#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "look/rules/matched.h"
#include "look/rules/repaired.h"

/* Append `more` to `to`. libcyaml allocates with malloc. If memory is short, nothing is lost. */
#define MOVE(to, n_to, more, n_more) move(&(to), &(n_to), (more), &(n_more), sizeof(*(to)))

static int move(void *to, uint32_t *n_to, void *more, uint32_t *n_more, size_t bytes)
{
	char *items;
	int err = *n_more ? memory_resize(to, (size_t)*n_to + *n_more, bytes) : 0;

	if (err)
		return err;
	memcpy(&items, to, sizeof(items));
	if (*n_more)
		memcpy(items + *n_to * bytes, more, *n_more * bytes);
	*n_to += *n_more;
	*n_more = 0; /* an empty array remains, to be freed later */
	return 0;
}

/* The later rule wins; the other one is freed with the rules that `more` came from. */
#define LATER(member) \
	do { \
		const void *earlier = to->member; \
\
		if (more->member) { \
			to->member = more->member; \
			memcpy(&more->member, &earlier, sizeof(earlier)); \
		} \
	} while (0)

static void take_single(struct rules *to, struct rules *more)
{
	LATER(sky);
	LATER(gloss);
	LATER(spare);
	LATER(replace);
}

int rules_join(struct look **into, struct look **from)
{
	struct look *to = *into, *more = *from;
	uint32_t n_draws, n_unseen, more_draws, more_unseen;
	int err = 0;

	if (!to || !more) {
		*into = to ? to : more;
		*from = NULL;
		return 0;
	}
	n_draws = to->rules->surfaces_count;
	n_unseen = to->rules->unseen_count;
	more_draws = more->rules->surfaces_count;
	more_unseen = more->rules->unseen_count;
	/* Our arrays run parallel to the lists of rules; one may have grown when another has not. */
	err = memory_resize(&to->draws, (size_t)n_draws + more_draws + 1, sizeof(*to->draws));
	if (!err)
		err = memory_resize(&to->unseen, (size_t)n_unseen + more_unseen + 1, sizeof(*to->unseen));
	if (!err)
		err = matched_append(to->matched, &more->matched);
	if (!err)
		err = MOVE(to->rules->surfaces, to->rules->surfaces_count, more->rules->surfaces, more->rules->surfaces_count);
	if (!err)
		err = MOVE(to->draws, n_draws, more->draws, more_draws);
	if (!err)
		err = MOVE(to->rules->unseen, to->rules->unseen_count, more->rules->unseen, more->rules->unseen_count);
	if (!err)
		err = MOVE(to->unseen, n_unseen, more->unseen, more_unseen);
	if (!err)
		err = MOVE(to->rules->lights, to->rules->lights_count, more->rules->lights, more->rules->lights_count);
	if (!err)
		err = MOVE(to->rules->world, to->rules->world_count, more->rules->world, more->rules->world_count);
	if (!err)
		err = MOVE(to->rules->parameters, to->rules->parameters_count, more->rules->parameters,
		           more->rules->parameters_count);
	if (err)
		return err;
	take_single(to->rules, more->rules);
	if (!to->repaired) {
		to->repaired = more->repaired;
		more->repaired = NULL;
	}
	rules_free(from);
	return 0;
}
