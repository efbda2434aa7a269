#include "tracer/accel/blas_cache.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define SLOTS 4096u /* of the hash table; some tens of thousands of meshes are no more than a dozen each */

struct entry {
	struct bottom bottom; /* the first member: entries are found by it */
	struct grove_key key;
	size_t bytes;
	unsigned users;  /* who copies from it */
	int made;        /* 0: someone is at it */
	struct entry *next;             /* in the same slot */
	struct entry *older, *younger;  /* made ones, by last use */
};

struct grove {
	pthread_mutex_t lock; /* of all below */
	pthread_cond_t changed;
	struct entry *slots[SLOTS];
	struct entry *oldest, *youngest;
	size_t most, bytes;
};

int grove_create(size_t most, struct grove **out)
{
	struct grove *grove = calloc(1, sizeof(*grove));

	*out = grove;
	if (!grove)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	grove->most = most;
	pthread_mutex_init(&grove->lock, NULL);
	pthread_cond_init(&grove->changed, NULL);
	return 0;
}

static struct entry **find(struct grove *grove, const struct grove_key *key)
{
	struct entry **at = &grove->slots[key->hash[0] % SLOTS];

	while (*at && memcmp(&(*at)->key, key, sizeof(*key)) != 0)
		at = &(*at)->next;
	return at;
}

/* --- By last use ---------------------------------------------------------------------------------------------------- */

static void unlink_use(struct grove *grove, struct entry *e)
{
	*(e->older ? &e->older->younger : &grove->oldest) = e->younger;
	*(e->younger ? &e->younger->older : &grove->youngest) = e->older;
}

static void link_youngest(struct grove *grove, struct entry *e)
{
	e->older = grove->youngest;
	e->younger = NULL;
	*(e->older ? &e->older->younger : &grove->oldest) = e;
	grove->youngest = e;
}

static void drop(struct grove *grove, struct entry *e)
{
	*find(grove, &e->key) = e->next;
	if (e->made) {
		unlink_use(grove, e);
		grove->bytes -= e->bytes;
	}
	bottom_free(&e->bottom);
	free(e);
}

static void keep_bound(struct grove *grove)
{
	for (struct entry *e = grove->oldest, *next; e && grove->bytes > grove->most; e = next) {
		next = e->younger;
		if (!e->users)
			drop(grove, e);
	}
}

void grove_destroy(struct grove **grove)
{
	struct grove *g = *grove;

	*grove = NULL;
	if (!g)
		return;
	while (g->oldest)
		drop(g, g->oldest);
	pthread_cond_destroy(&g->changed);
	pthread_mutex_destroy(&g->lock);
	free(g);
}

/* --- Taking and giving ---------------------------------------------------------------------------------------------- */

static struct entry *add(struct grove *grove, const struct grove_key *key)
{
	struct entry *e = calloc(1, sizeof(*e)), **slot = find(grove, key);

	if (e) {
		e->key = *key;
		*slot = e;
	}
	return e;
}

int grove_take(struct grove *grove, const struct grove_key *key, const struct bottom **out)
{
	struct entry *e;
	int err = 0;

	*out = NULL;
	pthread_mutex_lock(&grove->lock);
	while ((e = *find(grove, key)) && !e->made)
		pthread_cond_wait(&grove->changed, &grove->lock);
	if (e) {
		unlink_use(grove, e);
		link_youngest(grove, e);
		e->users++;
		*out = &e->bottom;
	} else if (!add(grove, key)) {
		err = err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	}
	pthread_mutex_unlock(&grove->lock);
	return err;
}

void grove_release(struct grove *grove, const struct bottom *bottom)
{
	struct entry *e = (struct entry *)bottom;

	pthread_mutex_lock(&grove->lock);
	e->users--;
	keep_bound(grove);
	pthread_mutex_unlock(&grove->lock);
}

const struct bottom *grove_give(struct grove *grove, const struct grove_key *key, struct bottom *bottom)
{
	struct entry *e;

	pthread_mutex_lock(&grove->lock);
	e = *find(grove, key);
	e->bottom = *bottom;
	e->bytes = bottom_bytes(bottom);
	e->users = 1;
	e->made = 1;
	grove->bytes += e->bytes;
	link_youngest(grove, e);
	pthread_cond_broadcast(&grove->changed);
	pthread_mutex_unlock(&grove->lock);
	*bottom = (struct bottom){ .n = { 0 } };
	return &e->bottom;
}

void grove_abandon(struct grove *grove, const struct grove_key *key)
{
	pthread_mutex_lock(&grove->lock);
	drop(grove, *find(grove, key));
	pthread_cond_broadcast(&grove->changed);
	pthread_mutex_unlock(&grove->lock);
}
