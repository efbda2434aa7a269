/*
 * A key that switches recording on and off. It reaches the program as well. A process of its own watches it, so the loss of the
 * display ends that process and nothing else.
 */
#pragma once

#include <sys/types.h>

/**
 * @param name  as X calls the key: "F9", "Pause", "r"
 * @return 0, ERR_USAGE (reported: there is no such key) or ERR_SYSTEM (reported: no X library, no display)
 */
int key_check(const char *name);

/** Start watching: each press sends `signal` to this process. Returns the watcher; -1 where it cannot be started. */
pid_t key_watch(const char *name, int signal);

/** End the watcher and wait for its end; nothing for -1. */
void key_forget(pid_t watcher);
