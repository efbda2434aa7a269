#ifndef REPLAY_GL_STATE_CONFIG_H
#define REPLAY_GL_STATE_CONFIG_H

struct gls_exec;
struct gls_state;
struct trace_value;

/** The bits of drawables that a context made for this visual or configuration draws to, as far as they are known. */
void gls_config_apply(struct gls_exec *x, struct gls_state *st, const struct trace_value *config);

#endif
