/* Identifies the layout of snapshots by a number. */
#pragma once

#include <stdint.h>

/**
 * Hash of the layout of snapshots: names, offsets and sizes of the members of all saved structs, and the commands that
 * lists refer to by number. A build reads only snapshots whose layout equals its own.
 */
uint64_t snapshot_layout(void);
