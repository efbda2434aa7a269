/* Shortcuts for display lists in frames that are skipped. */
#pragma once

struct gls_exec;
struct gls_list;
struct gls_state;

/**
 * The ops to run instead of a called list: its effect, borrowed until lists or textures are deleted; NULL: run the list
 * itself.
 */
const struct gls_effect *gls_effect_of(const struct gls_exec *x, struct gls_state *st, struct gls_list *list);
