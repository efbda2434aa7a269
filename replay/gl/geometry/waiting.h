/*
 * Material colours that wait. In Mesa, values set by glMaterial and glColor outside Begin and End stay in the vertex
 * store (22.3.6, vbo_exec_api.c) until that is emptied or read, and only then become current. With COLOR_MATERIAL this
 * is visible: a waiting parameter overwrites the colour that Enable and ColorMaterial have copied, unless the colour
 * changes as well; and for vertices without colours, the parameter is used (until Mesa 25.0, SCENE_MESA_TRACKS_COLORS).
 * This differs from the specification (GL 2.1 sec. 2.14.3) and from other GLs, where nothing waits.
 */
#pragma once

#include <stdint.h>

struct gls_state;

/** Note that glMaterial has set colours of a side. @param colors  GLS_AMBIENT and so on */
void gls_waiting_set(struct gls_state *st, unsigned side, unsigned colors, const float value[4]);

/**
 * Note that a current attribute is set. @param carries  1: it is the colour; recolors: 1: it is the colour, and has
 * changed
 */
void gls_waiting_touch(struct gls_state *st, int carries, int recolors);

/** The current colour has changed: update the material parameters that track it (sec. 2.14.3). */
void gls_color_changed(struct gls_state *st);

/**
 * A command sets an attribute with n components. The first time that a command gives fewer components than before, Mesa
 * sets the others to those of (0, 0, 0, 1). It does not repeat this after a longer command in between: the last
 * components of that one are then kept. The alpha of glColor4f can therefore come back with glColor3f. Runs that the
 * recorder has turned into lists begin as if nothing had been set before.
 * @param value  [4], completed; in and out
 */
void gls_waiting_components(struct gls_state *st, unsigned attribute, unsigned n, float value[4]);

/** Make waiting values current. @param empties  1: the store is emptied; 0: it is only read */
void gls_waiting_take(struct gls_state *st, int empties);

/** A list has set attributes: they are current at once. */
void gls_waiting_current(struct gls_state *st);

/** At a Begin: values that waited before it do not belong to a vertex. */
void gls_waiting_begin(struct gls_state *st);
