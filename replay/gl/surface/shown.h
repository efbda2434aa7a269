/*
 * Pictures of framebuffer objects that are copied to the window unchanged, texel by pixel: by a textured quad, or a
 * blit of the whole picture. The window's scene then gets the draws that made the picture, as if they had been made
 * there; later draws over it follow in order. Toolkits compose windows of several such pictures. OpenGL's own pixels
 * are the same; rays see the scene and not a flat quad. If later frames show the same picture again, unchanged, they
 * get its scene too.
 *
 * The picture remains a picture if anything else affects the result: another scale, different depth bits or samples,
 * colours without 8 bits per channel, blending with the object's own alpha, an object that shows earlier frames,
 * stipples and programs that depend on window positions, pixels and bitmaps if only a part of the window is covered, a
 * window with depths of its own.
 */
#pragma once

#include "replay/build/frame.h"
#include "replay/gl/surface/framebuffer.h"

/**
 * Call before a draw reads its textures: finds the draws that made the texture it may show, and updates the texture.
 * @return to be passed to gls_shown_end
 */
struct gls_drawn gls_shown_by_draw(struct gls_exec *x, struct gls_state *st, const struct gls_event *e);

/** As gls_shown_by_draw, before a blit reads. */
struct gls_drawn gls_shown_by_blit(struct gls_exec *x, struct gls_state *st);

/**
 * Call after the draw or blit: if it showed the picture unchanged, replaces it by the picture's events. If a checkpoint
 * did not include them, the frames that drew the picture are played again.
 * @param drawn  its reference is taken
 */
void gls_shown_end(struct gls_exec *x, struct gls_state *st, struct gls_drawn drawn);
