/*
 * Bottom levels that the workers of one process share, found by content: each is made once, by whoever wants it first. Others
 * wait for that one, and copy it into their pools.
 *
 * It holds about so many bytes as it is told; what was unused for longest goes. All functions may be called from any thread.
 */
#ifndef TRACER_ACCEL_BLAS_CACHE_H
#define TRACER_ACCEL_BLAS_CACHE_H

#include "tracer/accel/blas.h"

struct blas_cache;

/* What a BLAS is found by. */
struct blas_key {
	uint64_t hash[2]; /* of the mesh */
	uint32_t kind;    /* enum accel_kind */
	uint32_t wide;    /* as of blas_make */
};

#define BLAS_CACHE_BYTES (256u << 20)

/**
 * @param most  bytes that it may hold beside what is in use
 * @return 0 or ERR_SYSTEM (reported)
 */
int blas_cache_create(size_t most, struct blas_cache **out);

/** Nobody may be using it. */
void blas_cache_destroy(struct blas_cache **cache);

/**
 * Find a BLAS, waiting where someone else is making it.
 *
 * @param out  receives it; unchanged until blas_cache_release(), which the caller owes. NULL: there is none, and the caller is to make it:
 *             blas_cache_publish() or blas_cache_abandon() is owed instead
 * @return 0 or ERR_SYSTEM (reported)
 */
int blas_cache_acquire(struct blas_cache *cache, const struct blas_key *key, const struct blas **out);
void blas_cache_release(struct blas_cache *cache, const struct blas *blas);

/**
 * What blas_cache_acquire() asked for.
 * @param blas  moved into the cache and left empty
 * @return where it is now; as blas_cache_acquire() gives it, blas_cache_release() is owed
 */
const struct blas *blas_cache_publish(struct blas_cache *cache, const struct blas_key *key, struct blas *blas);

/** It will not come: one of those who wait makes it. */
void blas_cache_abandon(struct blas_cache *cache, const struct blas_key *key);

#endif
