/* Front buffers of double-buffered windows. */
#pragma once

struct gls_drawable;
struct gls_exec;
struct gls_state;
struct gls_surface;

/** 1 where the context draws to its window's front buffer beside a back buffer; draws to nothing else; reads from
 * it. */
int gls_front_is_drawn(const struct gls_state *st);
int gls_front_alone_is_drawn(const struct gls_state *st);
int gls_front_is_read(const struct gls_state *st);

/** From now until the next swap the front buffer is apart from the back buffer. @return it */
struct gls_surface *gls_front_part(struct gls_exec *x, struct gls_drawable *d);

/** The back buffer, whose scene has just ended, was swapped to the front. */
void gls_front_swapped(struct gls_drawable *d);
