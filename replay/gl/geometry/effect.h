/* What is left of a display list in frames that are skipped. */
#ifndef REPLAY_GL_GEOMETRY_EFFECT_H
#define REPLAY_GL_GEOMETRY_EFFECT_H

struct gls_exec;
struct gls_list;
struct gls_state;

/** What to run instead of a list that is called now: its effect, borrowed until lists or textures go; NULL: the list itself. */
const struct gls_effect *gls_effect_of(const struct gls_exec *x, struct gls_state *st, struct gls_list *list);

#endif
