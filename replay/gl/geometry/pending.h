/*
 * Pending vertices (GL 2.1 sec. 2.6, 2.7): what Begin/End collects until somebody draws it.
 *
 * Pairs of Begin and End with the same kind of primitive share one mesh, as long as no state changes that draws look
 * at.
 */
#pragma once

#include <stdint.h>

struct gls_exec;
struct gls_state;

/** Draw what is pending. Called before state changes that draws look at; the dispatcher does so for most commands. */
void gls_flush(struct gls_exec *x);

/** The same, but attributes that wait go on waiting (waiting.h). */
void gls_draw_pending(struct gls_exec *x);

/** Set a current attribute. */
void gls_set_attribute(struct gls_exec *x, struct gls_state *st, unsigned attribute, const float value[4]);
/** Set a generic attribute (sec. 2.7): 0 is a vertex where a Begin is open. A number that there is none of is the
 * program's error. */
void gls_set_generic(struct gls_exec *x, struct gls_state *st, uint32_t number, const float value[4]);
/** 0: nothing draws a vertex that comes now: no Begin is open (undefined, sec. 2.6.3; Mesa draws nothing), or no frame
 * is wanted. */
int gls_takes_vertices(const struct gls_exec *x, const struct gls_state *st);
/** A vertex of the open Begin; ignored where gls_takes_vertices says so. */
void gls_vertex(struct gls_exec *x, struct gls_state *st, const float position[4]);

/** mode: a GL token. Errors as glBegin has them. */
void gls_begin(struct gls_exec *x, struct gls_state *st, uint32_t mode);
void gls_end(struct gls_exec *x, struct gls_state *st);
/** The primitive ends and another one of its kind begins (NV_primitive_restart). */
void gls_restart(struct gls_exec *x, struct gls_state *st);

/** A material parameter is about to change, perhaps between Begin and End. */
void gls_before_material(struct gls_exec *x, struct gls_state *st);
