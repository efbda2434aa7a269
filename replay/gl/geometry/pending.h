/*
 * Pending vertices (GL 2.1 sec. 2.6, 2.7): collected by Begin/End until something draws them.
 *
 * Begin/End pairs with the same kind of primitive share one mesh, as long as no state changes that draws depend on.
 */
#pragma once

#include <stdint.h>

struct gls_exec;
struct gls_state;

/**
 * Draw the pending vertices. Must be called before state changes that draws depend on; the dispatcher does so for most
 * commands.
 */
void gls_flush(struct gls_exec *x);

/** As gls_flush, but leaves waiting attributes waiting (waiting.h). */
void gls_draw_pending(struct gls_exec *x);

/** Set a current attribute. */
void gls_set_attribute(struct gls_exec *x, struct gls_state *st, unsigned attribute, const float value[4]);
/** Set a generic attribute (sec. 2.7): number 0 is a vertex inside Begin/End. An invalid number is a GL error. */
void gls_set_generic(struct gls_exec *x, struct gls_state *st, uint32_t number, const float value[4]);
/**
 * @return 0: a vertex specified now is not drawn, because there is no open Begin (undefined, sec. 2.6.3; Mesa draws
 *         nothing) or no frame is wanted
 */
int gls_takes_vertices(const struct gls_exec *x, const struct gls_state *st);
/** Add a vertex to the open Begin; ignored if gls_takes_vertices returns 0. */
void gls_vertex(struct gls_exec *x, struct gls_state *st, const float position[4]);

/** mode: a GL token. Raises the errors of glBegin. */
void gls_begin(struct gls_exec *x, struct gls_state *st, uint32_t mode);
void gls_end(struct gls_exec *x, struct gls_state *st);
/** End the primitive and begin another one of the same kind (NV_primitive_restart). */
void gls_restart(struct gls_exec *x, struct gls_state *st);

/** Call before a material parameter changes, possibly between Begin and End. */
void gls_before_material(struct gls_exec *x, struct gls_state *st);
