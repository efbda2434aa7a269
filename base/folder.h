/* Output folders, made on first use. */
#pragma once

#include <stddef.h>

/** Make a folder and its parents, where they are missing. @return 0 or ERR_SYSTEM (reported) */
int folder_make(const char *path);

/** The same without a report, for folders that are optional. @return 0, or the errno that says why not */
int folder_try(const char *path);

/**
 * The nearest that is there of a folder and those that it would lie in. What it gives has a '/', or is ".".
 * @return 1; 0: the path is too long
 */
int folder_nearest(const char *path, char *out, size_t size);

/**
 * folder_try, before it is known whether anything will come into it. At exit the folder goes again where it was made here and is empty.
 * @param on_success  1: also where the exit code is 0
 * @return 0, or the errno that says why not
 */
int folder_try_early(const char *path, int on_success);

/** What exit does about those after a failure, for a process that ends by _exit. */
void folder_drop_early(void);

/**
 * The user's cache folder: $XDG_CACHE_HOME, or ~/.cache (XDG base directory specification 0.8). It may not exist yet.
 * @return as of folder_cached
 */
int folder_caches(char *out, size_t size);

/**
 * A path in it: relume/NAME.
 * @return 1; 0 where the user has no such folder, or the path is too long
 */
int folder_cached(const char *name, char *out, size_t size);

/** Make the folder of a file, and its parents. @return 0 or ERR_SYSTEM (reported) */
int folder_make_for(const char *file);

/** Remove a folder and all that is in it; links in it are not followed. What stays is named in a warning. */
void folder_remove(const char *path);
