/* Failures in a handler: GL errors of the program, calls that are not supported yet, and our own failures. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gls_exec;
struct gls_state;
struct table;

/** Record a GL error of the program in the current call. The handler must change nothing else. */
void gls_error(struct gls_exec *x, struct gls_state *st, uint32_t error);

/** As gls_error, if `wrong`. @return wrong */
static inline bool gls_refuses(struct gls_exec *x, struct gls_state *st, bool wrong, uint32_t error)
{
	if (wrong)
		gls_error(x, st, error);
	return wrong;
}

/** As gls_error, with an error code from a table or rule; 0 is no error. @return true if there was an error */
static inline bool gls_refuses_by(struct gls_exec *x, struct gls_state *st, uint32_t error)
{
	return gls_refuses(x, st, error != 0, error);
}

/**
 * Copy a program's reason into storage that lives as long as the counts: the program may be linked again or deleted.
 */
const char *gls_reason(struct gls_exec *x, const char *why);

/** Count the current call as unsupported. why: the part that is missing; must live as long as the counts. */
void gls_unsupported(struct gls_exec *x, const char *why);

/** Reason for gls_unsupported: the call needs rendered pixels, and there is no renderer. */
extern const char gls_needs_renderer[];

/** Reason for gls_unsupported: the draw uses shaders or programs. */
extern const char gls_programs[];

/**
 * The frame needs pixels of skipped frames: make the replay go back (gls_feedback). why: what shows those pixels, a
 * static string.
 */
void gls_rewind(struct gls_exec *x, const char *why);

/** Scratch memory of n bytes, valid until the next call of gls_scratch; NULL: out of memory (reported). */
void *gls_scratch(struct gls_exec *x, size_t n);
/** Create an object of n zeroed bytes under `name` in a table, which owns it. @return NULL: out of memory (reported) */
void *gls_object_create(struct gls_exec *x, struct table *t, uint64_t name, size_t n);
/** Report that memory ran out. The replay ends after this call. */
void gls_out_of_memory(struct gls_exec *x, size_t bytes);
/** End the replay after this call, for a failure that is already reported. */
void gls_fail(struct gls_exec *x);

/**
 * Limit the work that a few calls can ask for. Lists that call themselves, or call each other twice, run longer than
 * anybody would wait, in a driver as well; draws with endless instances do too. A frame's limit on multiplied work
 * grows with each call recorded so far, and is far above what real programs reach.
 *
 * @param n    additional work: operations of a list called by a list, instances, some points of evaluated meshes
 * @param why  reason to count the call under if the limit is exceeded
 * @return 1 if the limit is exceeded
 */
int gls_is_beyond_measure(struct gls_exec *x, uint64_t n, const char *why);
