/*
 * A cache folder that can be written. PoCL offers no device without one, so that a service or a build server whose user has no
 * home could render nothing.
 */
#pragma once

/**
 * Where relume/ or pocl/ in the user's cache folder ($XDG_CACHE_HOME, or ~/.cache) cannot be made or written, set XDG_CACHE_HOME to
 * a folder of this user's in $TMPDIR (or /tmp), which later runs find again (unless another user has taken its name: then each run makes one), and say so in one line. Before the first thread,
 * and before files are confined. Does nothing the second time.
 */
void caches_find(void);
