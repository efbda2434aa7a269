/*
 * Builds the index of a trace, by replaying it once.
 *
 * Checkpoints are at least one MiB of calls apart; more if the state is large, so that restoring it is never slower
 * than replaying the calls since the last checkpoint, and the index does not outgrow the trace.
 */
#pragma once

#include "replay/index/index.h"

struct player;

enum index_mode {
	INDEX_KEEP, /* use an existing one, else build one */
	INDEX_FORCE /* build one */
};

/**
 * Open the index of a trace, or build it if there is none, or if it is out of date or damaged.
 * @param path   of the trace
 * @param hash   hash_name
 * @param fresh  a player of the trace that has executed nothing: used if an index is built; NULL: one is opened
 * @return 0; ERR_INPUT or ERR_SYSTEM (reported). Failing to write the index is only a warning: this process can use it,
 *         and the next one builds it again
 */
int index_open(struct index **out, const char *path, const char *hash, enum index_mode mode, struct player *fresh);
