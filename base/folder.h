/* Folders for output: made when something is to be written into them. */
#ifndef BASE_FOLDER_H
#define BASE_FOLDER_H

#include <stddef.h>

/** Make a folder and those above it; one that is there is fine. @return 0 or ERR_SYSTEM (reported) */
int folder_make(const char *path);

/** The same for what can be done without: nothing is reported. @return 0, or the errno that says why not */
int folder_try(const char *path);

/**
 * A place in the user's cache folder: $XDG_CACHE_HOME/relume/NAME, or ~/.cache/relume/NAME (XDG base directory
 * specification 0.8). It need not be there.
 * @return 1; 0 where the user has none, or the name is too long
 */
int folder_cached(const char *name, char *out, size_t size);

/** Make the folder that a file is to lie in, and those above it. @return 0 or ERR_SYSTEM (reported) */
int folder_make_for(const char *file);

#endif
