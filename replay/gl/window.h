#ifndef REPLAY_GL_WINDOW_H
#define REPLAY_GL_WINDOW_H

#include <stdint.h>

struct gls_context;
struct gls_exec;

/** ctx NULL: none is current any more. */
void gls_make_current(struct gls_exec *x, struct gls_context *ctx, uint64_t drawable, uint64_t read);

#endif
