/* The bits of visuals and frame buffer configurations, as recordings of other recorders reveal them. */
#pragma once

struct gls_exec;
struct gls_state;
struct trace_value;

/** Set a context's bits to those of the visual or configuration that it is created for, as far as they are known. */
void gls_config_apply(struct gls_exec *x, struct gls_state *st, const struct trace_value *config);
