/* Front buffers of double-buffered windows. */
#pragma once

struct gls_drawable;
struct gls_exec;
struct gls_state;
struct gls_surface;

/** 1 if the context draws to its window's front buffer beside a back buffer; draws only to it; reads from it. */
int gls_front_is_drawn(const struct gls_state *st);
int gls_front_alone_is_drawn(const struct gls_state *st);
int gls_front_is_read(const struct gls_state *st);

/** Separate the front buffer from the back buffer until the next swap. @return the front buffer */
struct gls_surface *gls_front_part(struct gls_exec *x, struct gls_drawable *d);

/** The back buffer, whose scene has just ended, was swapped to the front. */
void gls_front_swapped(struct gls_drawable *d);
