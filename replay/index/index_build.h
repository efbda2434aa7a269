/*
 * Makes the index of a trace, by replaying it once.
 *
 * A checkpoint stands a MiB of calls after the one before it at least; later where the state is large, where restoring
 * it would take longer than the calls since the last one, or where the index would outgrow the trace.
 */
#pragma once

#include "replay/index/index.h"

struct player;

enum index_mode {
	INDEX_KEEP, /* use the one that is there, else make one */
	INDEX_FORCE /* make one */
};

/**
 * Open the index of a trace, or make it: where there is none, where it is stale, and where it is damaged.
 * @param path   of the trace
 * @param hash   hash_name
 * @param fresh  a player of the trace that has executed nothing: it is run through where an index is made; NULL: one is
 *               opened
 * @return 0; ERR_INPUT or ERR_SYSTEM (reported). An index that can be made but not written is a warning: this process
 *         has it, the next one makes it again
 */
int index_open(struct index **out, const char *path, const char *hash, enum index_mode mode, struct player *fresh);
