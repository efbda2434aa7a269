/* Texture images: specifying them (GL 2.1 sec. 3.8.1 - 3.8.3), and pixels on their way in (sec. 3.6). */
#ifndef REPLAY_GL_TEXTURE_TEXIMAGE_H
#define REPLAY_GL_TEXTURE_TEXIMAGE_H

#include <stddef.h>
#include <stdint.h>

struct call;
struct gls_exec;
struct gls_level;
struct gls_state;
struct gls_texture;

/**
 * Client pixels to texels (sec. 3.6.4): unpack state, format, type and pixel transfer.
 * @param depth  of images of three dimensions; 0: of two, for which no images are skipped
 * @param out  width * height * depth texels of the internal format, RGBA or one float where its base is DEPTH_COMPONENT
 * @return 0; -1: format or type is not known (error set); -2: too few bytes (what is there was read)
 */
int gls_unpack_pixels(struct gls_exec *x, struct gls_state *st, uint32_t format, uint32_t type, uint32_t width,
                      uint32_t height, uint32_t depth, const uint8_t *data, size_t n, uint32_t internal_format,
                      uint8_t *out);

/** The stencil values of pixels of the format DEPTH_STENCIL, a byte each. What is not there is 0. */
void gls_unpack_stencil(const struct gls_state *st, uint32_t type, uint32_t width, uint32_t height, const uint8_t *data, size_t n,
                        uint8_t *out);

/** A colour through pixel transfer (sec. 3.6.5; rgba is changed) into a texel of an internal format. */
void gls_store_pixel(const struct gls_state *st, uint32_t internal_format, float rgba[4], uint8_t *out);

/** The object whose level a call names, or NULL (error set; proxies: NULL and no error). */
struct gls_texture *gls_texture_find_level(struct gls_exec *x, struct gls_state *st, uint32_t token, int64_t level,
                                           unsigned *face);

/** Make a level anew, texels all 0. @return the level, or NULL: it has no texels (error set where it is one) */
struct gls_level *gls_texture_specify(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, unsigned face,
                                      int64_t level, uint32_t internal_format, int64_t width, int64_t height, int64_t depth,
                                      int64_t border);

/** Levels above the base level out of it (sec. 3.8.8). */
void gls_texture_generate_mipmaps(struct gls_exec *x, struct gls_texture *t, unsigned face);

/** The bytes of a pixel argument: client memory, or a place in the bound unpack buffer. NULL: there are none. */
const uint8_t *gls_pixel_source(struct gls_state *st, const struct call *c, unsigned i, size_t *n);

#endif
