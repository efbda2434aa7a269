#ifndef REPLAY_GL_SURFACE_FRONT_H
#define REPLAY_GL_SURFACE_FRONT_H

struct gls_drawable;
struct gls_exec;
struct gls_state;
struct gls_surface;

/* Two buffers of a window */
struct gls_target {
	struct gls_surface *surface;
	int colored; /* 0: the context draws to another buffer, which has the same depth and stencil buffers */
};
/** The surfaces that an event of the context changes. @return how many; 0: none, or out of memory */
unsigned gls_targets_of(struct gls_exec *x, struct gls_state *st, struct gls_target out[2]);
/** 1 where the context draws to its window's front buffer beside a back buffer; where it reads from that. */
int gls_front_is_drawn(const struct gls_state *st);
int gls_front_is_read(const struct gls_state *st);
/** From now until the next swap the front buffer is apart from the back buffer. @return it */
struct gls_surface *gls_front_part(struct gls_exec *x, struct gls_drawable *d);
/** The back buffer, whose scene has just ended, was swapped to the front. */
void gls_front_swapped(struct gls_drawable *d);

#endif
