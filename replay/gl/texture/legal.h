/*
 * Validity of images (GL 2.1 sec. 3.6.4, 3.8.1 - 3.8.3), as in Mesa (22.3.6), or in later versions as `mesa`, bits of
 * enum scene_mesa, says. An invalid call changes nothing.
 */
#pragma once

#include <stdint.h>

struct gls_level;

/** The error for pixels with a format and a type (tables 3.5 to 3.8); 0: valid. */
uint32_t gls_pixels_error(uint32_t format, uint32_t type, uint32_t mesa);

/** 1 if pixels of a format can become texels of an internal format: depth to depth, colour to colour. */
int gls_formats_agree(uint32_t internal_format, uint32_t format);

/** 1 if a command for images with this number of dimensions accepts a target that is not a proxy. */
int gls_takes_target(unsigned n_dims, uint32_t target);

/** The error for a new image of a target; 0: valid. @param size  [2], with border */
uint32_t gls_image_error(uint32_t target, uint32_t internal_format, int64_t level, const int64_t size[2],
                         int64_t border, uint32_t mesa);

/** The error for a compressed image of n_bytes bytes; 0: valid. @param size  [3] */
uint32_t gls_compressed_error(uint32_t internal_format, const int64_t size[3], int64_t border, int64_t n_bytes);

/**
 * 1 if a part of a level can be set separately: in a compressed level, only whole blocks, except at the far edges.
 * @param at, size  [2]
 */
int gls_part_is_whole(const struct gls_level *l, const int64_t at[2], const int64_t size[2]);
