/*
 * What OpenGL refuses of images (GL 2.1 sec. 3.6.4, 3.8.1 - 3.8.3), as Mesa (22.3.6) has it, and later ones where
 * `mesa`, bits of enum scene_mesa, say so. A call that is refused changes nothing.
 */
#pragma once

#include <stdint.h>

struct gls_level;

/** The error of pixels of a format and a type (tables 3.5 to 3.8); 0: there is none. */
uint32_t gls_pixels_error(uint32_t format, uint32_t type, uint32_t mesa);

/** Whether pixels of a format can become texels of an internal format: depths depths, colours colours. */
int gls_formats_agree(uint32_t internal_format, uint32_t format);

/** Whether a command for images of so many dimensions takes a target that is no proxy. */
int gls_takes_target(unsigned n_dims, uint32_t target);

/** The error of a new image for a target; 0: there is none. @param size  [2], with border */
uint32_t gls_image_error(uint32_t target, uint32_t internal_format, int64_t level, const int64_t size[2],
                         int64_t border, uint32_t mesa);

/** The error of a compressed image of so many bytes; 0: there is none. @param size  [3] */
uint32_t gls_compressed_error(uint32_t internal_format, const int64_t size[3], int64_t border, int64_t n_bytes);

/** Whether a part of a level can be set by itself: of a compressed one whole blocks, but at its far sides. @param at,
 * size  [2] */
int gls_part_is_whole(const struct gls_level *l, const int64_t at[2], const int64_t size[2]);
