/* Begin/End and vertex attributes (GL 2.1 sec. 2.6, 2.7), for other chapters. */
#ifndef REPLAY_GL_GEOMETRY_VERTEX_H
#define REPLAY_GL_GEOMETRY_VERTEX_H

#include "replay/machine/commands.h"

gls_handler gls_glBegin, gls_glEnd, gls_glEdgeFlag, gls_glEdgeFlagv;

void gls_set_attribute(struct gls_exec *x, struct gls_state *st, unsigned attribute, const float value[4]);
void gls_vertex(struct gls_exec *x, struct gls_state *st, const float position[4]);
void gls_color_changed(struct gls_state *st);
/** Called before a material parameter changes, which may happen between Begin and End. */
void gls_before_material(struct gls_exec *x, struct gls_state *st);

#endif
