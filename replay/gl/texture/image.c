/* Completeness of textures (sec. 3.8.10), and the cache of their images. */
#include "replay/gl/texture/image.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "gl_tokens.h"
#include "kernels/gl/blend.h"
#include "replay/gl/texture/level.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

#define IMAGE_KEEP_FRAMES 8                  /* number of frames that an unused image is kept */
#define IMAGE_KEEP_BYTES ((size_t)64 << 20) /* cache size below which nothing is dropped */

static uint32_t half(uint32_t size)
{
	return size > 1 ? size / 2 : 1;
}

static int is_mipmapped(uint32_t filter)
{
	return filter != GL_NEAREST && filter != GL_LINEAR;
}

/* Consecutive levels of a texture that are consistent with each other. */
struct chain {
	uint32_t n;   /* number of levels, from the base level on; 0: no base image */
	int complete; /* 1: reaches down to one texel, or to the last level that the parameters allow */
};

static struct chain find_chain(const struct gls_texture *t, unsigned face)
{
	const struct gls_texture_parameters *p = &t->parameters;
	const struct chain none = { 0, 0 };
	const struct gls_level *base, *level;
	uint32_t w, h, d, n;

	if (p->base_level >= GLS_MAX_LEVELS || p->base_level > p->max_level)
		return none;
	base = &t->levels[face][p->base_level];
	if (!base->texels)
		return none;
	w = base->width - 2 * base->border;
	h = t->target == GLS_TEXTURE_1D ? 1 : base->height - 2 * base->border;
	d = gls_texture_depth(t, base);
	if (!w || !h || !d)
		return none; /* only borders */
	for (n = 1;
	     p->base_level + n < GLS_MAX_LEVELS && p->base_level + n <= p->max_level &&
	     (w > 1 || h > 1 || (d > 1 && t->target == GLS_TEXTURE_3D));
	     n++) {
		w = half(w);
		h = half(h);
		d = t->target == GLS_TEXTURE_3D ? half(d) : d;
		level = base + n;
		if (!level->texels || level->border != base->border || level->internal_format != base->internal_format ||
		    level->width != w + 2 * base->border ||
		    (t->target != GLS_TEXTURE_1D && level->height != h + 2 * base->border) ||
		    gls_texture_depth(t, level) != d)
			return (struct chain){ n, 0 };
	}
	return (struct chain){ n, 1 };
}

/* The levels that all faces have in common. */
static struct chain find_chains(const struct gls_texture *t)
{
	struct chain all = find_chain(t, 0);

	for (unsigned face = 1; face < 6 && t->target == GLS_TEXTURE_CUBE; face++) {
		struct chain c = find_chain(t, face);

		if (c.n < all.n)
			all = (struct chain){ c.n, 0 };
	}
	return all;
}

static int is_cube_complete(const struct gls_texture *t)
{
	const struct gls_level *first = &t->levels[0][t->parameters.base_level];

	for (unsigned face = 0; face < 6; face++) {
		const struct gls_level *base = &t->levels[face][t->parameters.base_level];
		if (!base->texels || base->width != base->height || base->width != first->width ||
		    base->internal_format != first->internal_format)
			return 0;
	}
	return 1;
}

/* Decode as llvmpipe does when it samples. With eight bits, dark colours would lack steps that an sRGB buffer shows. */
static void decode_srgb(uint8_t *to, const uint8_t *from, size_t n_texels)
{
	float linear[256], texel[4];

	for (unsigned i = 0; i < 256; i++)
		linear[i] = blend_linear_from_code(i);
	for (size_t i = 0; i < n_texels; i++, from += 4, to += sizeof(texel)) {
		for (unsigned k = 0; k < 4; k++)
			texel[k] = k < 3 ? linear[from[k]] : (float)from[k] / 255;
		memcpy(to, texel, sizeof(texel));
	}
}

static struct gls_texture_image *build_image(struct gls_exec *x, const struct gls_texture *t, uint32_t n_levels)
{
	const struct gls_level *base = &t->levels[0][t->parameters.base_level];
	unsigned n_faces = t->target == GLS_TEXTURE_CUBE ? 6 : 1;
	const struct gls_format *format = gls_format_find(base->internal_format);
	int srgb = format && format->srgb && t->parameters.srgb_decode != GL_SKIP_DECODE_EXT;
	uint32_t head[9] = { gls_texture_token(t->target), base->base_format, base->width - 2 * base->border,
	                     t->target == GLS_TEXTURE_1D ? 1 : base->height - 2 * base->border,
	                     gls_texture_depth(t, base), n_levels, base->border,
	                     (uint32_t)srgb,
	                     base->texel_bytes };
	const uint32_t texel_bytes = srgb ? 16 : base->texel_bytes;
	struct gls_texture_image *image;
	XXH3_state_t state;
	XXH128_hash_t hash;
	uint64_t key;
	size_t bytes = 0;
	uint8_t *at;

	XXH3_128bits_reset(&state);
	XXH3_128bits_update(&state, head, sizeof(head));
	for (uint32_t l = 0; l < n_levels; l++)
		for (unsigned face = 0; face < n_faces; face++) {
			const struct gls_level *level = &t->levels[face][t->parameters.base_level + l];
			XXH3_128bits_update(&state, level->texels, level->texel_bytes * gls_level_count(level));
			bytes += texel_bytes * gls_level_count(level);
		}
	hash = XXH3_128bits_digest(&state);
	for (key = hash.low64; (image = table_find(&x->caches.images, key)); key++)
		if (image->texture.hash[1] == hash.high64 && image->texture.hash[0] == hash.low64) {
			atomic_fetch_add(&image->refs, 1);
			return image;
		}
	image = calloc(1, sizeof(*image) + bytes);
	if (!image || table_set(&x->caches.images, key, image)) {
		free(image);
		gls_out_of_memory(x, bytes);
		return NULL;
	}
	atomic_init(&image->refs, 2); /* one for the cache, one for the caller */
	image->texture = (struct scene_texture){ .hash = { hash.low64, hash.high64 }, .target = head[0],
		.base_format = head[1], .width = head[2], .height = head[3], .depth = head[4], .n_levels = n_levels,
		.border = base->border, .floats = texel_bytes == 16, .n_bytes = bytes };
	image->texture.texels = at = (uint8_t *)(image + 1);
	for (uint32_t l = 0; l < n_levels; l++)
		for (unsigned face = 0; face < n_faces; face++) {
			const struct gls_level *level = &t->levels[face][t->parameters.base_level + l];
			if (srgb)
				decode_srgb(at, level->texels, gls_level_count(level));
			else
				memcpy(at, level->texels, level->texel_bytes * gls_level_count(level));
			at += texel_bytes * gls_level_count(level);
		}
	x->caches.image_bytes += bytes;
	return image;
}

struct gls_texture_image *gls_texture_image_find(struct gls_exec *x, uint32_t width, uint32_t height,
                                                 uint32_t texel_bytes, const uint8_t *texels)
{
	struct gls_texture t = { .target = GLS_TEXTURE_2D };
	struct gls_texture_image *image;

	t.levels[0][0] = (struct gls_level){ .width = width, .height = height, .depth = 1, .base_format = GL_RGBA,
		                             .texel_bytes = texel_bytes, .texels = (uint8_t *)(uintptr_t)texels,
		                             .bytes = (size_t)width * height * texel_bytes };
	image = build_image(x, &t, 1);
	if (image)
		image->used_frame = x->frame;
	return image;
}

struct gls_texture_image *gls_texture_image_of(struct gls_exec *x, struct gls_texture *t, uint32_t min_filter)
{
	struct chain c;

	if (!t->dirty && t->mipmapped == (uint32_t)is_mipmapped(min_filter))
		return t->image;
	t->mipmapped = (uint32_t)is_mipmapped(min_filter);
	gls_texture_image_release(t->image);
	t->image = NULL;
	t->dirty = 0;
	c = find_chains(t);
	if (c.n && (t->target != GLS_TEXTURE_CUBE || is_cube_complete(t)) && (c.complete || !t->mipmapped))
		t->image = build_image(x, t, t->mipmapped ? c.n : 1);
	return t->image;
}

void gls_texture_image_release(struct gls_texture_image *image)
{
	if (image && atomic_fetch_sub(&image->refs, 1) == 1)
		free(image);
}

/* Limit the cache's size: screen copies create a new image each frame. */
void gls_image_cache_trim(struct gls_exec *x)
{
	if (x->caches.image_bytes < IMAGE_KEEP_BYTES || x->frame % IMAGE_KEEP_FRAMES)
		return;
	for (size_t i = 0; i < x->caches.images.room;) {
		struct table_entry e = x->caches.images.entries[i];
		struct gls_texture_image *image = e.value;
		if (!image || atomic_load(&image->refs) > 1 || image->used_frame + IMAGE_KEEP_FRAMES > x->frame) {
			i++;
			continue;
		}
		x->caches.image_bytes -= image->texture.n_bytes;
		table_remove(&x->caches.images, e.key); /* may move another entry here: look at this place again */
		gls_texture_image_release(image);
	}
}

void gls_image_cache_free(struct gls_exec *x)
{
	TABLE_DROP(&x->caches.images, gls_texture_image_release);
}

