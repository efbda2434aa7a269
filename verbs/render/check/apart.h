/*
 * Runs a function in a child process, which may crash, hang or exit while the caller goes on. For OpenCL drivers: some
 * do all of that, and none survives a fork, so the caller must not have used OpenCL before.
 */
#pragma once

#include <stddef.h>

/** Zeroed memory that both processes see. @return NULL: out of memory (reported). Free with apart_free */
void *apart_alloc(size_t bytes);
void apart_free(void *memory, size_t bytes);

enum apart_end { APART_DONE, APART_DIED, APART_LATE };

/**
 * Run a function in a child process, and wait until it ends.
 * @param user     from apart_alloc, for the function's results
 * @param step     within it: changes as the function gets on
 * @param seconds  the child is killed after this time without a change of step, or if it uses more than half of the
 * machine's memory
 * @return how it ended; APART_DIED if no process can be started (reported)
 */
enum apart_end apart_run(void (*function)(void *user), void *user, const volatile int *step, double seconds);
