/*
 * Images of textures, as scenes use them. Equal images exist once: a cache finds them by a hash of their content. The
 * cache, the textures and the scenes that use an image each hold a reference.
 */
#pragma once

#include <stdatomic.h>
#include <stdint.h>

#include "scene/scene.h"

struct gls_exec;
struct gls_texture;

struct gls_texture_image {
	struct scene_texture texture; /* must be first; its texels follow this struct */
	atomic_uint refs;
	uint64_t used_frame;          /* last frame that drew with it */
	uint32_t slot;                /* its index in the scene whose serial is slot_frame */
	uint64_t slot_frame;
};

/**
 * The image that a draw with this filter uses. Borrowed; NULL: the texture is incomplete (sec. 3.8.10), or out of
 * memory (reported)
 */
struct gls_texture_image *gls_texture_image_of(struct gls_exec *x, struct gls_texture *t, uint32_t min_filter);

/** The image of plain RGBA texels that belong to no texture. @return a reference; NULL: out of memory (reported) */
struct gls_texture_image *gls_texture_image_find(struct gls_exec *x, uint32_t width, uint32_t height,
                                                 uint32_t texel_bytes, const uint8_t *texels);

void gls_texture_image_release(struct gls_texture_image *image);

/** Call between frames: drops images that only the cache holds and that no draw used for a while. */
void gls_image_cache_trim(struct gls_exec *x);
void gls_image_cache_free(struct gls_exec *x);
