/* Contexts, their state and the objects they share. */
#pragma once

#include <stdint.h>

struct gls_context;
struct gls_exec;
struct gls_share;
struct gls_state;
struct trace_value;

/** @return NULL: there is no live context with this handle */
struct gls_context *gls_context_find(struct gls_exec *x, uint64_t handle);
/**
 * @param share   handle of the context to share objects with, 0: none
 * @param config  the visual or configuration that it is created for, NULL: unknown
 * @param api     "GLX", "EGL" ...; not copied
 * @return borrowed, or NULL: not created (counted or reported)
 */
struct gls_context *gls_context_create(struct gls_exec *x, uint64_t handle, uint64_t share,
                                       const struct trace_value *config, const char *api);

/** Set GL's initial state; the drawable's size is not known yet. @return 0 or ERR_SYSTEM (reported) */
int gls_state_init(struct gls_state *st);
void gls_state_free(struct gls_state *st);

/** @return a share group for one context, or NULL: out of memory */
struct gls_share *gls_share_create(void);
