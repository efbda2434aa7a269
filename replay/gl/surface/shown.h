/*
 * Pictures of framebuffer objects that reach the window unchanged: by a textured quad that covers it, or a blit of all
 * of it. The window's scene is then what drew the picture, as if it had been drawn there; what the program draws over
 * it follows in order. OpenGL's own pixels stay the same; rays see the scene and not a flat quad.
 *
 * It is left as it is where anything but the picture counts: another size, other bits of depth or samples, colours that
 * are not 8 bits each, blending with the object's own alpha, an object that shows what earlier frames left, a window
 * that was drawn on before.
 */
#pragma once

#include "replay/build/frame.h"

/**
 * Before a draw looks at its textures: take the events that made the one that it may show. The texture is brought up to
 * date.
 * @return a frame to be given to gls_shown_end; NULL: there is none
 */
struct gls_frame *gls_shown_by_draw(struct gls_exec *x, struct gls_state *st, const struct gls_event *e);

/** The same before a blit reads. */
struct gls_frame *gls_shown_by_blit(struct gls_exec *x, struct gls_state *st);

/**
 * After the draw or blit: where it was the window's first and showed the picture unchanged, its events come in its
 * place.
 * @param drawn  taken, whatever comes of it; NULL: nothing happens
 */
void gls_shown_end(struct gls_exec *x, struct gls_state *st, struct gls_frame *drawn);
