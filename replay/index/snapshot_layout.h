/* What snapshots are made of, as a number. */
#pragma once

#include <stdint.h>

/**
 * Names what snapshots are made of: names, offsets and sizes of the members of all structs that are saved, and the
 * commands that lists hold by number. A build reads snapshots of equal layouts only.
 */
uint64_t snapshot_layout(void);
