/* What is left of a display list in frames that are skipped. */
#pragma once

struct gls_exec;
struct gls_list;
struct gls_state;

/** What to run instead of a list that is called now: its effect, borrowed until lists or textures go; NULL: the list
 * itself. */
const struct gls_effect *gls_effect_of(const struct gls_exec *x, struct gls_state *st, struct gls_list *list);
