/*
 * When are two calls of two recordings equal?
 *
 * Textures, lists, buffers, contexts and the like may be numbered differently in each. A name is defined by its first
 * use, so equal calls pair names, and a pair that contradicts an earlier one is a difference. Addresses in the
 * program's memory are ignored.
 */
#pragma once

#include "base/table.h"
#include "capture/format/call.h"

enum names_kind {
	NAMES_NONE, NAMES_TEXTURE, NAMES_LIST, NAMES_LIST_BASE, NAMES_BUFFER, NAMES_FRAMEBUFFER, NAMES_RENDERBUFFER,
	NAMES_PROGRAM, NAMES_SAMPLER, NAMES_VERTEX_ARRAY, NAMES_QUERY, NAMES_WINDOW, N_NAMES_KINDS
};

/* Pairs of names. All zero: none yet. */
struct names {
	struct table to[N_NAMES_KINDS], from[N_NAMES_KINDS]; /* the other name + 1 */
};
void names_free(struct names *names);

/**
 * Pair two names, unless either has another partner. 0 pairs only with 0.
 * @return 1: they are the same object from now on; 0: they cannot be; ERR_SYSTEM (reported)
 */
int names_pair(struct names *names, enum names_kind kind, uint64_t good, uint64_t bad);

/** A hash of the call and its arguments, without those that names_compare pairs or ignores. */
uint64_t names_hash(const struct call *call);

/**
 * Compare two calls of the same command.
 * @param argument  receives the first argument that differs
 * @return 1 equal; 0 different; ERR_SYSTEM (reported)
 */
int names_compare(struct names *names, const struct call *good, const struct call *bad, uint32_t *argument);
