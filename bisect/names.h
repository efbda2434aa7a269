/*
 * When do two calls of two recordings say the same?
 *
 * Textures, lists, buffers, contexts and the like may be numbered differently in each: a name means what it was first met as, so equal
 * calls pair names, and a pair that contradicts an earlier one is a difference. Addresses in the program's memory mean nothing.
 */
#pragma once

#include "base/table.h"
#include "capture/format/call.h"

enum names_kind {
	NAMES_NONE, NAMES_TEXTURE, NAMES_LIST, NAMES_LIST_BASE, NAMES_BUFFER, NAMES_FRAMEBUFFER, NAMES_RENDERBUFFER, NAMES_PROGRAM,
	NAMES_SAMPLER, NAMES_VERTEX_ARRAY, NAMES_QUERY, NAMES_WINDOW, N_NAMES_KINDS
};

/* Pairs of names. All zero: none yet. */
struct names {
	struct table to[N_NAMES_KINDS], from[N_NAMES_KINDS]; /* the other name + 1 */
};
void names_free(struct names *names);

/** 1 where both names may be the same object; from now on they are. A name of 0 is 0 in both. @return ERR_SYSTEM (reported), too */
int names_pair(struct names *names, enum names_kind kind, uint64_t good, uint64_t bad);

/** A hash of the call and its arguments. What names_compare pairs or passes over counts as equal. */
uint64_t names_hash(const struct call *call);

/**
 * Compare two calls of the same command.
 * @param argument  receives the first argument that parts
 * @return 1 the same; 0 they part; ERR_SYSTEM (reported)
 */
int names_compare(struct names *names, const struct call *good, const struct call *bad, uint32_t *argument);
