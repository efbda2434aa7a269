/* Bounded cache folders: the least recently used files are removed. */
#pragma once

#include <stdint.h>

/**
 * If the matching files of a folder take more than `most` bytes, remove the least recently used until `left` bytes
 * remain. Several processes may do so at the same time.
 * @param pattern  matches file names (fnmatch)
 * @return 1; 0: the folder cannot be read
 */
int folder_keep_bound(const char *folder, const char *pattern, uint64_t most, uint64_t left);
