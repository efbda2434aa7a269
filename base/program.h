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
 * @param quiet 1: its errors go nowhere, for a question that may have no answer
 * @param out   receives what it prints, NUL-terminated, the caller's; NULL also on failure
 * @return its exit code, 128 + N where signal N ended it, or ERR_SYSTEM (reported) where it does not start
 */
int program_read(char *const *argv, int quiet, char **out);

/** The same; what it prints goes to standard output, after what this process has printed. */
int program_run(char *const *argv);
