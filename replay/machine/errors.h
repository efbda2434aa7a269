/* What can go wrong in a handler: errors of the program, calls that are not done yet, failures of ours. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gls_exec;
struct gls_state;
struct table;

/** The program made a GL error in the current call. The handler changes nothing else. */
void gls_error(struct gls_exec *x, struct gls_state *st, uint32_t error);

/** The same where it is `wrong`. @return wrong */
static inline bool gls_refuses(struct gls_exec *x, struct gls_state *st, bool wrong, uint32_t error)
{
	if (wrong)
		gls_error(x, st, error);
	return wrong;
}

/** The same with what a table or a rule says: 0 is no error. @return whether there is one */
static inline bool gls_refuses_by(struct gls_exec *x, struct gls_state *st, uint32_t error)
{
	return gls_refuses(x, st, error != 0, error);
}

/** A program's reason, as a string that lives as long as what is counted: the program may be linked again, or go. */
const char *gls_reason(struct gls_exec *x, const char *why);

/** Count the current call as not done. why: the part that is missing; lives as long as what is counted. */
void gls_unsupported(struct gls_exec *x, const char *why);

/** What gls_unsupported says of calls that need pixels where nothing renders. */
extern const char gls_needs_renderer[];

/** What it says of draws by shaders or programs. */
extern const char gls_programs[];

/** The frame needs pixels of skipped frames: the replay goes back (gls_feedback). why: what shows them, a static
 * string. */
void gls_rewind(struct gls_exec *x, const char *why);

/** Scratch memory of n bytes, valid until the next call of this; NULL: out of memory (reported). */
void *gls_scratch(struct gls_exec *x, size_t n);
/** An object of n bytes, all zero, under its name in a table, which owns it. @return NULL: out of memory (reported) */
void *gls_object_create(struct gls_exec *x, struct table *t, uint64_t name, size_t n);
/** Report that memory is short. The replay ends after this call. */
void gls_out_of_memory(struct gls_exec *x, size_t bytes);
/** End the replay after this call, for a failure that is already reported. */
void gls_fail(struct gls_exec *x);

/**
 * Bound the work that a few calls can ask for. Lists that call themselves, or each other twice, run longer than anybody
 * waits, in a driver too; so do draws of endless instances. A frame may multiply its work by so much for each call
 * recorded so far that no program comes near it.
 * @param n    more work: operations of a list called by a list, instances, some points of evaluated meshes
 * @param why  what to count the call as if it is too much
 * @return 1 if it is too much
 */
int gls_is_beyond_measure(struct gls_exec *x, uint64_t n, const char *why);
