/* Display lists and their meshes in a snapshot. A list is a blob: most are the same at every checkpoint. */
#ifndef REPLAY_INDEX_SNAPSHOT_LISTS_H
#define REPLAY_INDEX_SNAPSHOT_LISTS_H

#include "replay/index/snapshot_parts.h"

extern const struct snapshot_table snapshot_lists;

#endif
