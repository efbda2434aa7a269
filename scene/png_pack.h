/* Pixels and textures as PNG in memory. */
#pragma once

#include "scene/scene.h"

/* Rows of bytes, the first one on top. */
struct png_pixels {
	const uint8_t *bytes;
	uint32_t width, height;
	size_t row_bytes;
	int has_alpha; /* 4 bytes a pixel, else 3 */
};

/**
 * @param out  receives a buffer; caller frees with free()
 * @return 0 or ERR_SYSTEM (reported)
 */
int png_pack(const struct png_pixels *pixels, uint8_t **out, size_t *n);

/** Level 0 of a texture that holds colours, without its border; of a cube or volume its first picture. Row t = 0 is the
 * top one. @return as png_pack */
int png_pack_texture(const struct scene_texture *t, uint8_t **out, size_t *n);
