/*
 * Texture objects (GL 2.1 sec. 3.8) and the images that scenes show of them.
 */
#ifndef REPLAY_GL_TEXTURE_TEXTURE_H
#define REPLAY_GL_TEXTURE_TEXTURE_H

#include "replay/machine/exec.h"

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

/* ---- pixels, teximage.c ---- */

/**
 * Client pixels to texels (sec. 3.6.4): unpack state, format, type and pixel transfer.
 * @param depth  of images of three dimensions; 0: of two, for which no images are skipped
 * @param out  width * height * depth texels of the internal format, RGBA or one float where its base is DEPTH_COMPONENT
 * @return 0; -1: format or type is not known (error set); -2: too few bytes (what is there was read)
 */
int gls_unpack_pixels(struct gls_exec *x, struct gls_state *st, uint32_t format, uint32_t type, uint32_t width,
                      uint32_t height, uint32_t depth, const uint8_t *data, size_t n, uint32_t internal_format,
                      uint8_t *out);

/**
 * Pixels of COLOR_INDEX or STENCIL_INDEX (sec. 3.6.5): shifted, offset, through the maps; pixels.c.
 * @param texels  receives colours, or stencil values of 4 bytes
 * @return 0, or -1: no type of indices
 */
int gls_unpack_indices(const struct gls_state *st, uint32_t format, uint32_t type, const uint8_t *data, size_t n, uint32_t width,
                       uint32_t height, uint8_t *texels);

/** The stencil values of pixels of the format DEPTH_STENCIL, a byte each. What is not there is 0. */
void gls_unpack_stencil(const struct gls_state *st, uint32_t type, uint32_t width, uint32_t height, const uint8_t *data, size_t n,
                        uint8_t *out);

/** A colour through pixel transfer (sec. 3.6.5; rgba is changed) into a texel of an internal format. */
void gls_store_pixel(const struct gls_state *st, uint32_t internal_format, float rgba[4], uint8_t *out);

/** Whatever the client's format was, a block-compressed image as texels of the internal format; texcompress.c. @return 0; -1: too few bytes */
int gls_decompress(uint32_t internal_format, uint32_t width, uint32_t height, const uint8_t *data, size_t n, uint8_t *out);

/** The object whose level a call names, or NULL (error set; proxies: NULL and no error). */
struct gls_texture *gls_texture_find_level(struct gls_exec *x, struct gls_state *st, uint32_t token, int64_t level,
                                           unsigned *face);

/** Make a level anew, texels all 0. @return the level, or NULL: it has no texels (error set where it is one) */
struct gls_level *gls_texture_specify(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, unsigned face,
                                      int64_t level, uint32_t internal_format, int64_t width, int64_t height, int64_t depth,
                                      int64_t border);

/** Levels above the base level out of it (sec. 3.8.8). */
void gls_texture_generate_mipmaps(struct gls_exec *x, struct gls_texture *t, unsigned face);

/** `missing` of the first level that misses pixels; 0: there is none. */
uint32_t gls_texture_missing(const struct gls_texture *t);

/** The image of plain RGBA texels (no texture object's), found by content. @return a reference, or NULL: out of memory */
struct gls_texture_image *gls_texture_image_find(struct gls_exec *x, uint32_t width, uint32_t height, uint32_t texel_bytes,
                                                 const uint8_t *texels);

/** The bytes of a pixel argument: client memory, or a place in the bound unpack buffer. NULL: there are none. */
const uint8_t *gls_pixel_source(struct gls_state *st, const struct call *c, unsigned i, size_t *n);

/* ---- internal formats, texformat.c ---- */

/* A number in [0,1] as 8 bits. */
static inline uint8_t gls_byte(float value)
{
	float v = value > 0 ? value : 0; /* so written, what is no number is 0, and nothing branches */

	v = v < 1 ? v : 1;
	return (uint8_t)(v * 255.0f + 0.5f);
}

struct gls_format {
	uint32_t token, base; /* base: table 3.15; RED and RG beside (ARB_texture_rg) */
	uint8_t bits[4];      /* of R G B A (L and I: of R) where fewer than 8 are stored; 0: 8 */
	uint8_t srgb;         /* 1: colours are encoded as sRGB says, and sampled in linear light */
	uint8_t block_bytes;  /* of 4x4 texels (8x4 of FXT1) in client memory where it is compressed; else 0 */
	/* 1: Mesa compresses plain pixels to S3TC. A block of one colour then keeps 5, 6 and 5 bits of it, cut off and not rounded;
	   so does every texel here, which is all that is done of that compression */
	uint8_t s3tc;
	uint8_t numbers; /* enum gls_numbers */
};

/* Formats whose texels are four floats, which may be beyond [0,1]: what numbers they can hold. */
enum gls_numbers { GLS_BYTES, GLS_SNORM8, GLS_SNORM16, GLS_FLOAT, GLS_HALF, GLS_11F, GLS_9E5 };

/** NULL: none that fixed function could sample. */
const struct gls_format *gls_format_find(uint32_t internal_format);
/** Base format of an internal format, 0: none. */
uint32_t gls_base_format(uint32_t internal_format);
/** Of a surface that such a texture or renderbuffer is attached to. */
uint32_t gls_format_depth_bits(uint32_t internal_format);
uint32_t gls_format_stencil_bits(uint32_t internal_format);
/** 1: a drawable that such a texture or renderbuffer is attached to holds floats. */
uint32_t gls_format_is_float(uint32_t internal_format);
/** Of a texel: 4, or 16 where it is four floats. */
uint32_t gls_texel_bytes(uint32_t internal_format);
/** A colour as a texel, rounded to what the format can hold, expanded as sampling does (table 3.20). */
void gls_format_store(const struct gls_format *f, const float rgba[4], uint8_t *out);
/** The same of a colour that was drawn. */
void gls_format_draw(const struct gls_format *f, const float rgba[4], uint8_t *out);
/** The same as gls_format_store in four bytes, whatever the format. */
void gls_format_store_bytes(const struct gls_format *f, const float rgba[4], uint8_t out[4]);
/** What a texel holds. */
void gls_texel_load(uint32_t texel_bytes, const uint8_t *texel, float out[4]);
/** A border colour as sampling a format gives it: no number that its texels could not be. */
void gls_format_border(uint32_t internal_format, const float color[4], float out[4]);
/** EXT_texture_sRGB, of one channel in [0,1]. */
float gls_linear_from_srgb(float c);
float gls_srgb_from_linear(float c);

#endif
