/* Run programs by argument vector, without a shell. */
#pragma once

/** 1 where a program of that name is in PATH. */
int program_exists(const char *name);

/**
 * Run a program to its end. Its errors go to standard error.
 * @param argv  ended by NULL; argv[0] is looked up in PATH
 * @param quiet 1: its errors go nowhere, for a question that may have no answer
 * @param out   receives what it prints, NUL-terminated, the caller's; NULL also on failure
 * @return its exit code, 128 + N where signal N ended it, or ERR_SYSTEM (reported) where it does not start
 */
int program_read(char *const *argv, int quiet, char **out);
