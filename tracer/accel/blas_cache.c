#include "tracer/accel/blas_cache.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define SLOTS 4096u /* slots of the hash table; tens of thousands of meshes give about a dozen entries each */

struct entry {
	struct blas blas; /* must be the first member: a pointer to it is cast to its entry */
	struct blas_key key;
	size_t bytes;
	unsigned users;  /* number of threads copying from it */
	int made;        /* 0: another thread is building it */
	struct entry *next;             /* in the same slot */
	struct entry *older, *younger;  /* list of built entries by last use */
};

struct blas_cache {
	pthread_mutex_t lock; /* guards all members below */
	pthread_cond_t changed;
	struct entry *slots[SLOTS];
	struct entry *oldest, *youngest;
	size_t most, bytes;
};

int blas_cache_create(size_t most, struct blas_cache **out)
{
	struct blas_cache *cache = calloc(1, sizeof(*cache));

	*out = cache;
	if (!cache)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	cache->most = most;
	pthread_mutex_init(&cache->lock, NULL);
	pthread_cond_init(&cache->changed, NULL);
	return 0;
}

static struct entry **find(struct blas_cache *cache, const struct blas_key *key)
{
	struct entry **at = &cache->slots[key->hash[0] % SLOTS];

	while (*at && memcmp(&(*at)->key, key, sizeof(*key)) != 0)
		at = &(*at)->next;
	return at;
}

/* --- By last use ------------------------------------------------------------------------------------------------- */

static void unlink_use(struct blas_cache *cache, struct entry *e)
{
	*(e->older ? &e->older->younger : &cache->oldest) = e->younger;
	*(e->younger ? &e->younger->older : &cache->youngest) = e->older;
}

static void link_youngest(struct blas_cache *cache, struct entry *e)
{
	e->older = cache->youngest;
	e->younger = NULL;
	*(e->older ? &e->older->younger : &cache->oldest) = e;
	cache->youngest = e;
}

static void drop(struct blas_cache *cache, struct entry *e)
{
	*find(cache, &e->key) = e->next; /* NOLINT(clang-analyzer-core.NullDereference): e is not NULL */
	if (e->made) {
		unlink_use(cache, e);
		cache->bytes -= e->bytes;
	}
	blas_free(&e->blas);
	free(e);
}

static void keep_bound(struct blas_cache *cache)
{
	for (struct entry *e = cache->oldest, *next; e && cache->bytes > cache->most; e = next) {
		next = e->younger;
		if (!e->users)
			drop(cache, e);
	}
}

void blas_cache_destroy(struct blas_cache **cache)
{
	struct blas_cache *g = *cache;

	*cache = NULL;
	if (!g)
		return;
	while (g->oldest)
		drop(g, g->oldest);
	pthread_cond_destroy(&g->changed);
	pthread_mutex_destroy(&g->lock);
	free(g);
}

/* --- Acquiring and publishing ------------------------------------------------------------------------------------ */

static struct entry *add(struct blas_cache *cache, const struct blas_key *key)
{
	struct entry *e = calloc(1, sizeof(*e)), **slot = find(cache, key);

	if (e) {
		e->key = *key;
		*slot = e;
	}
	return e;
}

int blas_cache_acquire(struct blas_cache *cache, const struct blas_key *key, const struct blas **out)
{
	struct entry *e;
	int err = 0;

	*out = NULL;
	pthread_mutex_lock(&cache->lock);
	while ((e = *find(cache, key)) && !e->made)
		pthread_cond_wait(&cache->changed, &cache->lock);
	if (e) {
		unlink_use(cache, e);
		link_youngest(cache, e);
		e->users++;
		*out = &e->blas;
	} else if (!add(cache, key)) {
		err = err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	}
	pthread_mutex_unlock(&cache->lock);
	return err;
}

void blas_cache_release(struct blas_cache *cache, const struct blas *blas)
{
	struct entry *e = (struct entry *)blas;

	pthread_mutex_lock(&cache->lock);
	e->users--;
	keep_bound(cache);
	pthread_mutex_unlock(&cache->lock);
}

const struct blas *blas_cache_publish(struct blas_cache *cache, const struct blas_key *key, struct blas *blas)
{
	struct entry *e;

	pthread_mutex_lock(&cache->lock);
	e = *find(cache, key);
	e->blas = *blas;
	e->bytes = blas_bytes(blas);
	e->users = 1;
	e->made = 1;
	cache->bytes += e->bytes;
	link_youngest(cache, e);
	pthread_cond_broadcast(&cache->changed);
	pthread_mutex_unlock(&cache->lock);
	*blas = (struct blas){ .n = { 0 } };
	return &e->blas;
}

void blas_cache_abandon(struct blas_cache *cache, const struct blas_key *key)
{
	pthread_mutex_lock(&cache->lock);
	drop(cache, *find(cache, key));
	pthread_cond_broadcast(&cache->changed);
	pthread_mutex_unlock(&cache->lock);
}
