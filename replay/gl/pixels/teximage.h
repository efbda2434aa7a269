/* Finds the texture image that a command of GL 2.1 sec. 3.8.1 - 3.8.3 names. */
#pragma once

#include "replay/gl/texture/texture.h"

/**
 * Find the texture whose level a command names, and bring it up to date with what was drawn to it.
 * @param token  target argument: a texture or the face of a cube
 * @return NULL: a proxy, or not a valid target or level (GL error)
 */
struct gls_texture *gls_texture_find_level(struct gls_exec *x, struct gls_state *st, uint32_t token, int64_t level,
                                           unsigned *face);
