/* What a handler meets: errors of the program, what is not done yet, failures of ours. */
#ifndef REPLAY_MACHINE_ERRORS_H
#define REPLAY_MACHINE_ERRORS_H

#include <stddef.h>
#include <stdint.h>

struct gls_exec;
struct gls_state;

/** A GL error of the program in the current call. */
void gls_error(struct gls_exec *x, struct gls_state *st, uint32_t error);

/** The current call, or the part of it named by `why` (a static string), is not done yet. */
void gls_unsupported(struct gls_exec *x, const char *why);

/** Scratch memory of n bytes, valid until the next call of this; NULL: out of memory (reported, x->failed). */
void *gls_scratch(struct gls_exec *x, size_t n);
/** Report that memory is short: the run ends with it. */
void gls_out_of_memory(struct gls_exec *x, size_t bytes);
/** The same where somebody else has reported it. */
void gls_fail(struct gls_exec *x);
/**
 * A list that calls the next one twice, and so on, or itself, runs longer than anybody waits, in a driver too; so do instances without
 * end. What a few calls make of themselves may come to so much a frame for each call recorded so far that no program comes near it.
 * @param n    more of it: operations that a list called by a list runs, instances, some points of evaluated meshes
 * @param why  what to count the call as where it is too much
 * @return 1 where it is too much
 */
int gls_is_beyond_measure(struct gls_exec *x, uint64_t n, const char *why);

#endif
