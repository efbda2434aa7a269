/*
 * Bottom levels that the workers of one process share, found by content: each is made once, by whoever wants it first. Others
 * wait for that one, and copy it into their pools.
 *
 * It holds about so many bytes as it is told; what was unused for longest goes. All functions may be called from any thread.
 */
#ifndef TRACER_ACCEL_BLAS_CACHE_H
#define TRACER_ACCEL_BLAS_CACHE_H

#include "tracer/accel/blas.h"

struct grove;

/* What a bottom level is found by. */
struct grove_key {
	uint64_t hash[2]; /* of the mesh */
	uint32_t kind;    /* enum accel_kind */
	uint32_t wide;    /* as of bottom_make */
};

#define GROVE_BYTES (256u << 20)

/**
 * @param most  bytes that it may hold beside what is in use
 * @return 0 or ERR_SYSTEM (reported)
 */
int grove_create(size_t most, struct grove **out);

/** Nobody may be using it. */
void grove_destroy(struct grove **grove);

/**
 * Find a bottom level, waiting where someone else is making it.
 *
 * @param out  receives it; unchanged until grove_release(), which the caller owes. NULL: there is none, and the caller is to make it:
 *             grove_give() or grove_abandon() is owed instead
 * @return 0 or ERR_SYSTEM (reported)
 */
int grove_take(struct grove *grove, const struct grove_key *key, const struct bottom **out);
void grove_release(struct grove *grove, const struct bottom *bottom);

/**
 * What grove_take() asked for.
 * @param bottom  moved into the grove and left empty
 * @return where it is now; as grove_take() gives it, grove_release() is owed
 */
const struct bottom *grove_give(struct grove *grove, const struct grove_key *key, struct bottom *bottom);

/** It will not come: one of those who wait makes it. */
void grove_abandon(struct grove *grove, const struct grove_key *key);

#endif
