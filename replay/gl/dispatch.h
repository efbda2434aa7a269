/* Calls to handlers, and what happens around every handler. */
#pragma once

#include "replay/machine/commands.h"

/* Of gls_commands, in the same order; NULL: none. Made by gen.py. */
extern gls_handler *const gls_handlers[];

int gls_exec_create(struct gls_exec **out, const char *path);
void gls_exec_destroy(struct gls_exec **x);

/** Go on counting where another machine stopped: the two exchange their counts. */
void gls_exec_take_counts(struct gls_exec *x, struct gls_exec *other);

/** Execute a call of the trace. @return 0 or ERR_SYSTEM (reported) */
int gls_exec_call(struct gls_exec *x, const struct call *c);
