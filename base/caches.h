/*
 * A writable cache folder. PoCL offers no device without one, so a service or build server whose user has no home
 * directory could not render.
 */
#pragma once

/**
 * If relume/ or pocl/ in the user's cache folder ($XDG_CACHE_HOME, or ~/.cache) cannot be made or written, set
 * XDG_CACHE_HOME to a private folder in $TMPDIR (or /tmp) and print one warning. Later runs use the same folder; if
 * another user has taken its name, each run makes a new one. Call before the first thread is started and before files
 * are confined. A second call does nothing.
 */
void caches_find(void);
