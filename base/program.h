/* Run programs by argument vector, without a shell. */
#pragma once

#include <stddef.h>

/**
 * Find a program as execvp does: a name with a slash is a path, any other is looked up in PATH.
 * @param out, size  receive its path
 * @return 1; 0: there is no executable file of that name
 */
int program_find(const char *name, char *out, size_t size);

/** The same without its path. */
int program_exists(const char *name);

/**
 * Run a program to its end. Its errors go to standard error.
 * @param argv  ended by NULL; argv[0] is looked up in PATH
 * @param quiet 1: discard its errors, for a query that is allowed to fail
 * @param out   receives its output, NUL-terminated, to be freed by the caller; NULL on failure
 * @return its exit code, 128 + N if signal N ended it, or ERR_SYSTEM (reported) if it cannot be started
 */
int program_read(char *const *argv, int quiet, char **out);

/** The same; its output goes to standard output, after this process's own. */
int program_run(char *const *argv);
