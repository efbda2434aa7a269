#ifndef REPLAY_GL_STATE_CONTEXT_H
#define REPLAY_GL_STATE_CONTEXT_H

#include <stdint.h>

struct gls_context;
struct gls_exec;

void gls_make_current(struct gls_exec *x, struct gls_context *ctx, uint64_t drawable, uint64_t read);

#endif
