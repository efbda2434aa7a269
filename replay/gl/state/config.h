/* Visuals and frame buffer configurations (GLX 1.4 sec. 3.3.3, EGL 1.5 sec. 3.4). */
#pragma once

struct gls_exec;
struct gls_state;
struct trace_value;

/** Set a context's bits to those of the visual or configuration that it is created for, as far as they are known. */
void gls_config_apply(struct gls_exec *x, struct gls_state *st, const struct trace_value *config);
