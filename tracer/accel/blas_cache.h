/*
 * A cache of BLASes that the workers of one process share, keyed by content. The first worker that needs a BLAS builds
 * it; the others wait for it and copy it into their pools.
 *
 * The cache has a size limit in bytes and evicts the least recently used BLAS first. All functions may be called from
 * any thread.
 */
#pragma once

#include "tracer/accel/blas.h"

struct blas_cache;

/* The key of a BLAS: its content. */
struct blas_key {
	uint64_t hash[2]; /* hash of the mesh */
	uint32_t kind;    /* enum accel_kind */
	uint32_t wide;    /* as in blas_make */
};

#define BLAS_CACHE_BYTES (256u << 20)

/**
 * @param most  most bytes it may hold besides BLASes in use
 * @return 0 or ERR_SYSTEM (reported)
 */
int blas_cache_create(size_t most, struct blas_cache **out);

/** Destroy a cache that nobody uses any more. */
void blas_cache_destroy(struct blas_cache **cache);

/**
 * Find a BLAS. Wait if another thread is building it.
 *
 * @param out  receives the BLAS, unchanged until blas_cache_release, which the caller must call. NULL if there is none:
 *             the caller builds it, then must call blas_cache_publish or blas_cache_abandon
 * @return 0 or ERR_SYSTEM (reported)
 */
int blas_cache_acquire(struct blas_cache *cache, const struct blas_key *key, const struct blas **out);
void blas_cache_release(struct blas_cache *cache, const struct blas *blas);

/**
 * Add the BLAS that blas_cache_acquire did not find.
 * @param blas  moved into the cache and left empty
 * @return its new address; the caller must call blas_cache_release
 */
const struct blas *blas_cache_publish(struct blas_cache *cache, const struct blas_key *key, struct blas *blas);

/** Give up building a BLAS. One of the threads waiting for it builds it instead. */
void blas_cache_abandon(struct blas_cache *cache, const struct blas_key *key);
