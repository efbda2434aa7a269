/*
 * Runs inside the traced program. Finds the real GL in the libraries that the program has loaded or, if it has none,
 * under the names used by Debian and its derivatives.
 */
#pragma once

#include "tables/commands.h"

#define RESOLVE_HIDDEN __attribute__((visibility("hidden")))

/** A sanitizer calls dlsym before it is ready itself, so everything used by dlsym must be free of instrumentation. */
#define RESOLVE_BEFORE_ALL no_sanitize("thread", "address")

extern RESOLVE_HIDDEN void *resolve_found[N_COMMANDS];
extern RESOLVE_HIDDEN void *(*resolve_real_dlsym)(void *handle, const char *name); /* NULL before resolve_dlsym */

/** Set resolve_real_dlsym. */
void resolve_dlsym(void);

/** A function of a library other than GL. */
void *resolve_in(void *library, const char *name);

/** Find a command's real function and remember it. If there is none: a function that does nothing and returns 0. */
void *resolve_command(unsigned command);

/** 1 if the command has a real function. */
int resolve_exists(unsigned command);

/** The number of a command, or N_COMMANDS. */
unsigned resolve_number(const char *name);

/**
 * The function to give the program for a name that the real GL resolves to `real`.
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
