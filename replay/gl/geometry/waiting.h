/*
 * Colours of materials that wait. What glMaterial and glColor set outside of Begin and End lies in Mesa's vertex store
 * (22.3.6, vbo_exec_api.c) until that is emptied or looked at, and becomes current then. With COLOR_MATERIAL this
 * shows: a parameter that waits comes over the colour that Enable and ColorMaterial have copied there, unless the
 * colour changes as well; and where vertices carry no colours, the parameter counts (until Mesa 25.0,
 * SCENE_MESA_TRACKS_COLORS). The specification has it otherwise (GL 2.1 sec. 2.14.3), and so have other GLs: nothing
 * waits there.
 */
#pragma once

#include <stdint.h>

struct gls_state;

/** glMaterial has set colours of a side. @param colors  GLS_AMBIENT and so on */
void gls_waiting_set(struct gls_state *st, unsigned side, unsigned colors, const float value[4]);

/** A current attribute is set. @param recolors  1: it is the colour, and another one; carries: 1: it is the colour */
void gls_waiting_touch(struct gls_state *st, int carries, int recolors);

/** The current colour has changed: tracked material parameters follow it (sec. 2.14.3). */
void gls_color_changed(struct gls_state *st);

/**
 * A command gives an attribute by n components. Mesa fills up the others with (0, 0, 0, 1) when commands give fewer
 * than before, but not once more after one that gave as many as there is room for: then the last ones of that stay. So
 * the alpha of glColor4f comes back with glColor3f. Runs that the recorder has made lists begin as if nothing had
 * been given before.
 * @param value  [4], filled up; in and out
 */
void gls_waiting_components(struct gls_state *st, unsigned attribute, unsigned n, float value[4]);

/** What waits becomes current. @param empties  1: the store is emptied; else it is looked at */
void gls_waiting_take(struct gls_state *st, int empties);

/** A list has set attributes: they are current at once. */
void gls_waiting_current(struct gls_state *st);

/** A Begin: what waited before it is no vertex's own. */
void gls_waiting_begin(struct gls_state *st);
