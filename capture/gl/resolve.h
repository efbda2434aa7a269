/*
 * Runs inside the traced program. Finding the real GL, by the libraries that the program has loaded or, where it has none, by the
 * names that Debian and its kin give them.
 */
#pragma once

#include "tables/commands.h"

#define RESOLVE_HIDDEN __attribute__((visibility("hidden")))

/** A sanitizer looks up what it replaces by dlsym before it is ready itself: what that needs must need nothing of it. */
#define RESOLVE_BEFORE_ALL no_sanitize("thread", "address")

extern RESOLVE_HIDDEN void *resolve_found[N_COMMANDS];
extern RESOLVE_HIDDEN void *(*resolve_real_dlsym)(void *handle, const char *name); /* NULL before resolve_dlsym */

/** Set resolve_real_dlsym. */
void resolve_dlsym(void);

/** A function of a library that is no GL. */
void *resolve_in(void *library, const char *name);

/** Find a command's real function and remember it. Where there is none, a function that does nothing and returns 0. */
void *resolve_command(unsigned command);

/** 1 where the command has a real function. */
int resolve_exists(unsigned command);

/** The number of a command, or N_COMMANDS. */
unsigned resolve_number(const char *name);

/**
 * What the program gets where the real GL has given out `real` for a name.
 * @param entry_points  ours, by command
 */
void *resolve_substitute(void *const entry_points[], const char *name, void *real);

/** OSMesa brings its own gl*: use these from now on. */
void resolve_prefer_osmesa(void);

static inline void *resolve_real(unsigned command)
{
	void *found = __atomic_load_n(&resolve_found[command], __ATOMIC_RELAXED); /* any thread's find is as good */

	return found ? found : resolve_command(command);
}
