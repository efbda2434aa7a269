/* Contexts, their state and what they share. */
#pragma once

#include <stdint.h>

struct gls_context;
struct gls_exec;
struct gls_share;
struct gls_state;
struct trace_value;

/** NULL: there is none of this handle that lives. */
struct gls_context *gls_context_find(struct gls_exec *x, uint64_t handle);
/**
 * @param share   handle of the context to share objects with, 0: none
 * @param config  the visual or configuration that it is made for, NULL: not known
 * @param api     "GLX", "EGL" ...; kept
 * @return borrowed, or NULL: none was made (counted or reported)
 */
struct gls_context *gls_context_create(struct gls_exec *x, uint64_t handle, uint64_t share,
                                       const struct trace_value *config, const char *api);

/** State as GL hands it out; the drawable's size is not known. @return 0 or ERR_SYSTEM (reported) */
int gls_state_init(struct gls_state *st);
void gls_state_free(struct gls_state *st);

/** @return a share group of one context, or NULL: out of memory */
struct gls_share *gls_share_create(void);
