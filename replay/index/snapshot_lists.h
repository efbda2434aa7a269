/* Display lists and their meshes in a snapshot. A list is a blob: most are the same at every checkpoint. */
#pragma once

#include "replay/index/snapshot_parts.h"

extern const struct snapshot_table snapshot_lists;
