/*
 * Pictures of framebuffer objects that reach the window unchanged, texel by pixel: by a textured quad, or a blit of all
 * of it. The window's scene then has what drew the picture, as if it had been drawn there; what the program draws over
 * it follows in order. Toolkits compose windows of several such pictures. OpenGL's own pixels stay the same; rays see
 * the scene and not a flat quad. Frames that show a picture again, which nobody has drawn on since, have its scene too.
 *
 * It is left as it is where anything but the picture counts: another scale, other bits of depth or samples, colours
 * that are not 8 bits each, blending with the object's own alpha, an object that shows what earlier frames left,
 * stipples and programs that tell one place of the window from another, pixels and bitmaps in a part of it, a window
 * that has depths of its own.
 */
#pragma once

#include "replay/build/frame.h"
#include "replay/gl/surface/framebuffer.h"

/**
 * Before a draw looks at its textures: what drew the one that it may show. The texture is brought up to date.
 * @return to be given to gls_shown_end
 */
struct gls_drawn gls_shown_by_draw(struct gls_exec *x, struct gls_state *st, const struct gls_event *e);

/** The same before a blit reads. */
struct gls_drawn gls_shown_by_blit(struct gls_exec *x, struct gls_state *st);

/**
 * After the draw or blit: where it showed the picture unchanged, its events come in its place. Where a checkpoint did
 * not hold them, the frames that drew it are played again.
 * @param drawn  its reference is taken
 */
void gls_shown_end(struct gls_exec *x, struct gls_state *st, struct gls_drawn drawn);
