/* Calls to handlers, and what happens around every handler. */
#ifndef REPLAY_GL_DISPATCH_H
#define REPLAY_GL_DISPATCH_H

#include <stdint.h>

struct call;
struct gls_exec;

int gls_exec_create(struct gls_exec **out, const char *path);
void gls_exec_destroy(struct gls_exec **x);

/** Go on counting calls, errors and what is not done where another machine stopped (the two exchange their counts). */
void gls_exec_take_counts(struct gls_exec *x, struct gls_exec *other);

/** Execute a call of the trace. @return 0 or ERR_SYSTEM (reported) */
int gls_exec_call(struct gls_exec *x, const struct call *c);

/** Run a command of the table as if it had been met (from lists and by handlers). */
void gls_dispatch(struct gls_exec *x, const struct call *c, uint32_t command);

/** Draw what is pending; called before any state that draws look at changes. */
void gls_flush(struct gls_exec *x);

#endif
