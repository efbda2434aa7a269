/* Folders of files that can be made again: those unused for longest go. */
#pragma once

#include <stdint.h>

/**
 * Where a folder's files of some names take more than so many bytes, remove those unused for longest. Others may do so at the same time.
 * @param pattern  of their names (fnmatch)
 * @param left     bytes that may stay then
 * @return 1; 0: the folder cannot be read
 */
int folder_keep_bound(const char *folder, const char *pattern, uint64_t most, uint64_t left);
