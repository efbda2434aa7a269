/*
 * BLASes that the workers of one process share, found by content. Whoever wants one first makes it; others wait for it
 * and copy it into their pools.
 *
 * The cache keeps to a number of bytes; the BLAS unused for longest goes first. All functions may be called from any
 * thread.
 */
#pragma once

#include "tracer/accel/blas.h"

struct blas_cache;

/* The content a BLAS is found by. */
struct blas_key {
	uint64_t hash[2]; /* of the mesh */
	uint32_t kind;    /* enum accel_kind */
	uint32_t wide;    /* as of blas_make */
};

#define BLAS_CACHE_BYTES (256u << 20)

/**
 * @param most  bytes that it may hold beside those in use
 * @return 0 or ERR_SYSTEM (reported)
 */
int blas_cache_create(size_t most, struct blas_cache **out);

/** Nobody may be using it. */
void blas_cache_destroy(struct blas_cache **cache);

/**
 * Find a BLAS; wait where someone else is making it.
 *
 * @param out  receives it; it stays as it is until blas_cache_release, which the caller owes. NULL: there is none; the
 *             caller makes it, and owes blas_cache_publish or blas_cache_abandon instead
 * @return 0 or ERR_SYSTEM (reported)
 */
int blas_cache_acquire(struct blas_cache *cache, const struct blas_key *key, const struct blas **out);
void blas_cache_release(struct blas_cache *cache, const struct blas *blas);

/**
 * Hand over the BLAS that blas_cache_acquire found missing.
 * @param blas  moved into the cache and left empty
 * @return where it is now; blas_cache_release is owed
 */
const struct blas *blas_cache_publish(struct blas_cache *cache, const struct blas_key *key, struct blas *blas);

/** The BLAS will not come: one of those who wait makes it. */
void blas_cache_abandon(struct blas_cache *cache, const struct blas_key *key);
