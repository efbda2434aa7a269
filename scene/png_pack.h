/* Packs pixels and textures as PNG in memory. */
#pragma once

#include "scene/scene.h"

/* Rows of bytes, top row first. */
struct png_pixels {
	const uint8_t *bytes;
	uint32_t width, height;
	size_t row_bytes;
	int has_alpha; /* 1: 4 bytes a pixel; 0: 3 bytes */
};

/**
 * Pack pixels.
 * @param out  receives a buffer; the caller frees it
 * @return 0 or ERR_SYSTEM (reported)
 */
int png_pack(const struct png_pixels *pixels, uint8_t **out, size_t *n);

/**
 * Pack level 0 of a colour texture, without its border; the first image of a cube or volume. Row t = 0 is the top row.
 * @return as png_pack
 */
int png_pack_texture(const struct scene_texture *t, uint8_t **out, size_t *n);
