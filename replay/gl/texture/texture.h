/*
 * Texture objects (GL 2.1 sec. 3.8) and the images that scenes show of them.
 */
#ifndef REPLAY_GL_TEXTURE_TEXTURE_H
#define REPLAY_GL_TEXTURE_TEXTURE_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "replay/machine/commands.h"
#include "replay/machine/state.h"
#include "scene/scene.h"

gls_handler gls_glBindTexture, gls_glActiveTexture;

#define GLS_MAX_LEVELS 15 /* 16384 texels at most */

/* One image of a mipmap, texels as in scene_texture, border included. */
struct gls_level {
	uint32_t width, height, depth; /* with border; 0: not specified */
	uint32_t border, internal_format, base_format;
	uint8_t *texels; /* where the format has stencil bits, a byte of stencil each after all of them */
	size_t bytes;    /* of both */
	uint32_t missing; /* frame + 1 in which what it holds was drawn, and not rendered; 0: it is all there */
	uint32_t texel_bytes; /* gls_texel_bytes of the internal format */
	uint64_t hash[2]; /* XXH3-128 of the texels, where the texture is hashed */
};

static inline size_t gls_level_count(const struct gls_level *l)
{
	return (size_t)l->width * l->height * l->depth;
}

/* Stencil values of a level, NULL where it has none. */
static inline uint8_t *gls_level_stencil(const struct gls_level *l)
{
	size_t texels = l->texel_bytes * gls_level_count(l);

	return l->texels && l->bytes > texels ? l->texels + texels : NULL;
}

struct gls_texture {
	uint32_t name, target; /* target: enum gls_texture_target; N_GLS_TEXTURE_TARGETS before the first bind */
	struct gls_level levels[6][GLS_MAX_LEVELS]; /* faces of cubes; others use face 0 */
	struct gls_texture_parameters parameters;
	uint32_t attached;               /* 1: is or was attached to a framebuffer object */
	uint32_t dirty;                  /* image must be found again */
	uint32_t hashed;                 /* 1: the levels' hashes are of their texels (snapshot.c) */
	uint32_t mipmapped;              /* the image was found for a filter that wants all levels */
	struct gls_texture_image *image; /* a reference, or NULL: incomplete */
};

/* A scene_texture of the cache; as gls_mesh. */
struct gls_texture_image {
	struct scene_texture texture; /* first */
	atomic_uint refs;
	uint64_t used_frame;
	uint32_t slot;
	uint64_t slot_frame;
};

/** Texels or levels have changed. */
static inline void gls_texture_changed(struct gls_texture *t)
{
	t->dirty = 1;
	t->hashed = 0;
}

/** The object bound to a target of a unit; never NULL but out of memory (x->failed). */
struct gls_texture *gls_texture_bound(struct gls_exec *x, struct gls_state *st, unsigned unit, unsigned target);

/** The image that a draw with this filter sees, NULL where the texture is incomplete (sec. 3.8.10). Borrowed. */
struct gls_texture_image *gls_texture_image_of(struct gls_exec *x, struct gls_texture *t, uint32_t min_filter);
/** Whose parameters a unit samples a texture by: the sampler object bound to it (GL 3.3 sec. 3.8.2), else the texture itself. */
const struct gls_texture *gls_texture_sampler(const struct gls_state *st, unsigned unit, const struct gls_texture *t);
/** The parameters of what is bound to each unit and target, for PushAttrib; they come back to objects that are still there. */
void gls_texture_save_parameters(const struct gls_state *st, struct gls_saved_texture saved[GLS_MAX_UNITS][N_GLS_TEXTURE_TARGETS]);
void gls_texture_restore_parameters(struct gls_state *st,
                                    const struct gls_saved_texture saved[GLS_MAX_UNITS][N_GLS_TEXTURE_TARGETS]);
void gls_texture_image_release(struct gls_texture_image *image);
void gls_texture_free(struct gls_texture *t);

/** gls_texture_target of a GL token (texture or cube face), -1: none. `face` receives 0 .. 5. */
int gls_texture_target_of(uint32_t token, unsigned *face);

/** `missing` of the first level that misses pixels; 0: there is none. */
uint32_t gls_texture_missing(const struct gls_texture *t);

/** The image of plain RGBA texels (no texture object's), found by content. @return a reference, or NULL: out of memory */
struct gls_texture_image *gls_texture_image_find(struct gls_exec *x, uint32_t width, uint32_t height, uint32_t texel_bytes,
                                                 const uint8_t *texels);

/** Drop images that the cache alone holds and that were not drawn for some frames, where the cache is large. */
void gls_image_cache_trim(struct gls_exec *x);
void gls_image_cache_free(struct gls_exec *x);
void gls_share_release(struct gls_share *share);

#endif
