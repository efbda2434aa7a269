/*
 * The images that scenes show of textures. Equal images exist once: a cache finds them by the hash of their content.
 * The cache holds a reference, and so does every texture and scene that uses one.
 */
#pragma once

#include <stdatomic.h>
#include <stdint.h>

#include "scene/scene.h"

struct gls_exec;
struct gls_texture;

struct gls_texture_image {
	struct scene_texture texture; /* first; its texels follow this struct */
	atomic_uint refs;
	uint64_t used_frame;          /* last frame that drew with it */
	uint32_t slot;                /* its place in the scene under construction, where slot_frame says so */
	uint64_t slot_frame;
};

/** The image that a draw with this filter sees. Borrowed; NULL: the texture is incomplete (sec. 3.8.10), or out of
 * memory (reported) */
struct gls_texture_image *gls_texture_image_of(struct gls_exec *x, struct gls_texture *t, uint32_t min_filter);

/** The image of plain RGBA texels that are no texture's. @return a reference; NULL: out of memory (reported) */
struct gls_texture_image *gls_texture_image_find(struct gls_exec *x, uint32_t width, uint32_t height,
                                                 uint32_t texel_bytes, const uint8_t *texels);

void gls_texture_image_release(struct gls_texture_image *image);

/** Between frames: drop images that only the cache holds and nobody drew with for a while. */
void gls_image_cache_trim(struct gls_exec *x);
void gls_image_cache_free(struct gls_exec *x);
