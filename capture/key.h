/*
 * Keys of the local keyboard, by their X names, and the one that switches recording on and off, which also reaches the
 * program. A separate process watches it, so that losing the display ends only that process.
 */
#pragma once

#include <sys/types.h>

enum { KEY_SHIFT = 1, KEY_CONTROL = 4, KEY_ALT = 8 }; /* ShiftMask, ControlMask, Mod1Mask of X */

struct key_code {
	int code;
	unsigned state; /* KEY_SHIFT if the key gives this name only with Shift: "A", "plus" */
};

/**
 * @param option  for messages: "--start-key"
 * @param name    as X calls the key: "F9", "Pause", "r"
 * @return 0, ERR_USAGE (reported: there is no such key) or ERR_SYSTEM (reported: no X library, no display)
 */
int key_find(const char *option, const char *name, struct key_code *out);

/**
 * Start watching a key that key_find has found: each press sends `signal` to this process.
 * @return the watcher; -1: it cannot be started
 */
pid_t key_watch(const char *name, int signal);

/** End the watcher and wait for its end; nothing for -1. */
void key_forget(pid_t watcher);
