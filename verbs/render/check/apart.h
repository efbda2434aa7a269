/*
 * A function in a process of its own: what it calls may crash, hang or end the process, and the caller goes on. For
 * OpenCL drivers, of which some do, and none outlives a fork: the caller has not touched OpenCL before.
 */
#pragma once

#include <stddef.h>

/** Memory, all 0, that both processes see. @return NULL: there is none (reported); apart_free */
void *apart_alloc(size_t bytes);
void apart_free(void *memory, size_t bytes);

enum apart_end { APART_DONE, APART_DIED, APART_LATE };

/**
 * Run a function in a child process, and wait for its end.
 * @param user     from apart_alloc, for what the function finds out
 * @param step     within it: changes as the function gets on
 * @param seconds  without a change after which the child is killed; so it is where it holds more than half of the
 * machine's memory
 * @return how it ended; APART_DIED where there is no process to be had (reported)
 */
enum apart_end apart_run(void (*function)(void *user), void *user, const volatile int *step, double seconds);
