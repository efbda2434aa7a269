/* Output folders, made on first use. */
#pragma once

#include <stddef.h>

/** Make a folder and any missing parents. @return 0 or ERR_SYSTEM (reported) */
int folder_make(const char *path);

/** The same without a report, for optional folders. @return 0 or the errno */
int folder_try(const char *path);

/**
 * Find the nearest existing folder among a folder and its parents. The result contains a '/', or is ".".
 * @return 1; 0: the path is too long
 */
int folder_nearest(const char *path, char *out, size_t size);

/**
 * folder_try for a folder that may remain empty. If it was made here and is still empty at exit, it is removed.
 * @param on_success  1: also if the exit code is 0
 * @return 0 or the errno
 */
int folder_try_early(const char *path, int on_success);

/** Remove those folders as exit does after a failure, for a process that ends by _exit. */
void folder_drop_early(void);

/**
 * The user's cache folder: $XDG_CACHE_HOME, or ~/.cache (XDG base directory specification 0.8). It may not exist yet.
 * @return as folder_cached
 */
int folder_caches(char *out, size_t size);

/**
 * The path of relume/NAME in the user's cache folder.
 * @return 1; 0 if the user has no cache folder or the path is too long
 */
int folder_cached(const char *name, char *out, size_t size);

/** Make the folder of a file, and its parents. @return 0 or ERR_SYSTEM (reported) */
int folder_make_for(const char *file);

/** Remove a folder and its contents, without following links. Warns of anything that cannot be removed. */
void folder_remove(const char *path);
