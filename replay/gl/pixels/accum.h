#ifndef REPLAY_GL_SURFACE_ACCUM_H
#define REPLAY_GL_SURFACE_ACCUM_H

struct gls_exec;
struct gls_state;

/** Clear the accumulation buffer (accum.c). */
void gls_accum_clear(struct gls_exec *x, struct gls_state *st);

#endif
