/* One image of a texture: a mipmap level, per face for a cube map (GL 2.1 sec. 3.8.1). */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define GLS_MAX_LEVELS 15 /* 16384 texels at most */

struct gls_level {
	uint32_t width, height, depth; /* with border; 0: not specified */
	uint32_t border, internal_format, base_format;
	uint8_t *texels; /* owned, as in scene_texture, with border; for formats with stencil, one byte of stencil per
	                    texel follows all texels */
	size_t bytes;    /* size of texels and stencil together */
	uint32_t missing; /* 1 + number of the skipped frame that drew to it; 0: nothing is missing */
	uint32_t missing_part[4]; /* x, y, width, height of the part that is missing; width 0: all of it */
	uint32_t texel_bytes; /* gls_texel_bytes of the internal format */
	uint64_t hash[2]; /* XXH3-128 of the texels, valid if the texture is hashed */
};

static inline size_t gls_level_count(const struct gls_level *l)
{
	return (size_t)l->width * l->height * l->depth;
}

/* Mark a whole level as missing (`missing` as above), or as complete (0). */
static inline void gls_level_lose(struct gls_level *l, uint32_t missing)
{
	l->missing = missing;
	memset(l->missing_part, 0, sizeof(l->missing_part));
}

/* Stencil values of a level, NULL if it has none. */
static inline uint8_t *gls_level_stencil(const struct gls_level *l)
{
	size_t texels = l->texel_bytes * gls_level_count(l);

	return l->texels && l->bytes > texels ? l->texels + texels : NULL;
}
