/*
 * Texture images (GL 2.1 sec. 3.8.1 - 3.8.3): TexImage, TexSubImage, compressed images, storage, copies and clears of
 * levels.
 */
#include "replay/gl/pixels/teximage.h"

#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/texture/legal.h"
#include "replay/gl/texture/level.h"
#include "replay/gl/texture/mipmap.h"
#include "replay/gl/texture/palette.h"
#include "replay/gl/texture/texcompress.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/unpack.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

struct gls_texture *gls_texture_find_level(struct gls_exec *x, struct gls_state *st, uint32_t token, int64_t level,
                                           unsigned *face)
{
	int target = gls_texture_target_of(token, face);
	struct gls_texture *t;

	if (token == GL_PROXY_TEXTURE_1D || token == GL_PROXY_TEXTURE_2D || token == GL_PROXY_TEXTURE_3D ||
	    token == GL_PROXY_TEXTURE_CUBE_MAP || token == GL_PROXY_TEXTURE_RECTANGLE || token == GL_PROXY_TEXTURE_1D_ARRAY ||
	    token == GL_PROXY_TEXTURE_2D_ARRAY || token == GL_PROXY_TEXTURE_CUBE_MAP_ARRAY)
		return NULL;
	if (target < 0) {
		gls_texture_no_target(x, st, token);
		return NULL;
	}
	if (gls_refuses(x, st, level < 0 || level >= GLS_MAX_LEVELS, GL_INVALID_VALUE))
		return NULL;
	t = gls_texture_bound(x, st, st->a.texturing.active, (unsigned)target);
	gls_texture_update(x, st, t);
	return t;
}

/* ---- images, sec. 3.8.1, 3.8.2 ---- */

/* The form given by the arguments of TexImage and CompressedTexImage. */
static struct gls_level_form form_of(const struct call *c, unsigned n_dims)
{
	return (struct gls_level_form){ arg_u(c, 2), arg_i(c, 3), n_dims > 1 ? arg_i(c, 4) : 1, n_dims > 2 ? arg_i(c, 5) : 1,
		                        arg_i(c, 3 + n_dims) };
}

/* The pixels of a TexImage or TexSubImage. format: number of that argument; type and data follow */
static struct gls_pixels pixels_of(const struct gls_exec *x, struct gls_state *st, const struct call *c,
                                   unsigned format, unsigned n_dims, const int64_t size[3])
{
	struct gls_pixels p = { .format = arg_u(c, format), .type = arg_u(c, format + 1), .width = (uint32_t)size[0],
		.height = (uint32_t)size[1], .depth = n_dims > 2 ? (uint32_t)size[2] : 0, .store = gls_client_store(x, st) };

	p.data = gls_pixel_source(st, c, format + 2, &p.n);
	return p;
}

/* Convert uncompressed pixels to the format's texels. @return as gls_unpack_pixels */
static int unpack_image(struct gls_exec *x, const struct gls_state *st, const struct gls_pixels *p,
                        uint32_t internal_format, uint8_t *texels)
{
	const struct gls_format *format = gls_format_find(internal_format);
	const int rc = gls_unpack_pixels(x, st, p, internal_format, texels);

	for (uint32_t z = 0; rc != -1 && format && format->s3tc && z < (p->depth ? p->depth : 1); z++)
		gls_recompress(format, p->width, p->height, p->width, texels + 4 * (size_t)z * p->width * p->height);
	return rc;
}

/* 1 if a TexImage with such pixels is a GL error. */
static int refuses_image(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n_dims,
                         const struct gls_level_form *form)
{
	const uint32_t format = arg_u(c, 4 + n_dims), wrong = gls_pixels_error(format, arg_u(c, 5 + n_dims), st->mesa),
		       image = gls_image_error(arg_u(c, 0), form->internal_format, arg_i(c, 1),
	                                       (int64_t[2]){ form->width, form->height }, form->border, st->mesa);

	return gls_refuses(x, st, !gls_takes_target(n_dims, arg_u(c, 0)), GL_INVALID_ENUM) ||
	       gls_refuses_by(x, st, wrong) || gls_refuses_by(x, st, image) ||
	       gls_refuses(x, st, !gls_formats_agree(form->internal_format, format), GL_INVALID_OPERATION);
}

/*
 * A level received texels from a command's argument i, all of them if `whole`: those missing in the source are missing
 * in the level.
 */
static void take_missing(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned i,
                         struct gls_level *l, int whole)
{
	const uint32_t missing = gls_pixel_missing(x, st, c, i);

	if (missing || (whole && l->missing))
		gls_level_lose(l, missing);
	x->feedback.missing |= missing != 0;
}

/* 1 if a part covers a whole level. */
static int is_whole(const struct gls_level *l, const int64_t size[3])
{
	return size[0] == l->width && size[1] == l->height && size[2] == l->depth;
}

GLS_FAMILY(glTexImage, STATE)
{
	const unsigned n_dims = gls_commands[x->command].suffix.n;
	unsigned face;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	const struct gls_level_form form = form_of(c, n_dims);
	struct gls_level *l;
	struct gls_pixels p;

	if (!t || refuses_image(x, st, c, n_dims, &form))
		return;
	l = gls_texture_specify(x, st, t, face, arg_i(c, 1), &form);
	if (!l)
		return;
	p = pixels_of(x, st, c, 4 + n_dims, n_dims, (const int64_t[3]){ l->width, l->height, l->depth });
	if (p.data && unpack_image(x, st, &p, l->internal_format, l->texels) == -2)
		gls_unsupported(x, "pixels beyond what the recording holds");
	if (p.data && gls_level_stencil(l) && p.format == GL_DEPTH_STENCIL)
		gls_unpack_stencil(&p, gls_level_stencil(l));
	take_missing(x, st, c, 6 + n_dims, l, 0);
	gls_texture_level_changed(x, t, face, arg_i(c, 1));
}

/* Copy values of `bytes` bytes, one per texel, to a place in a level's texels or stencil. */
static void place(const struct gls_level *l, uint8_t *to, size_t bytes, const int64_t at[3], const int64_t size[3],
                  const uint8_t *from)
{
	for (int64_t z = 0; z < size[2]; z++)
		for (int64_t y = 0; y < size[1]; y++)
			memcpy(to + bytes * (size_t)(((at[2] + z) * l->height + at[1] + y) * l->width + at[0]),
			       from + bytes * (size_t)((z * size[1] + y) * size[0]), bytes * (size_t)size[0]);
}

GLS_FAMILY(glTexSubImage, STATE)
{
	const unsigned n_dims = gls_commands[x->command].suffix.n;
	unsigned face;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	struct gls_level *l = t ? &t->levels[face][arg_i(c, 1)] : NULL;
	int64_t at[3] = { 0 }, size[3] = { 1, 1, 1 };
	struct gls_pixels p;
	uint8_t *texels;
	uint32_t wrong;

	if (!l || gls_refuses(x, st, !gls_takes_target(n_dims, arg_u(c, 0)), GL_INVALID_ENUM))
		return;
	if (gls_refuses(x, st, !l->texels, GL_INVALID_OPERATION))
		return;
	for (unsigned i = 0; i < n_dims; i++) {
		int64_t room = i == 0 ? l->width : i == 1 ? l->height : l->depth;

		at[i] = arg_i32(c, 2 + i) + l->border;
		size[i] = arg_i32(c, 2 + n_dims + i);
		if (gls_refuses(x, st, at[i] < 0 || size[i] < 0 || at[i] > room || size[i] > room - at[i], GL_INVALID_VALUE))
			return;
	}
	p = pixels_of(x, st, c, 2 + 2 * n_dims, n_dims, size);
	wrong = gls_pixels_error(p.format, p.type, st->mesa);
	if (gls_refuses_by(x, st, wrong) ||
	    gls_refuses(x, st, !gls_formats_agree(l->internal_format, p.format) || !gls_part_is_whole(l, at, size),
	                GL_INVALID_OPERATION))
		return;
	if (!p.data || !size[0] || !size[1] || !size[2])
		return;
	texels = gls_scratch(x, (size_t)(size[0] * size[1] * size[2]) * l->texel_bytes);
	if (!texels || unpack_image(x, st, &p, l->internal_format, texels) == -1)
		return;
	place(l, l->texels, l->texel_bytes, at, size, texels);
	if (gls_level_stencil(l) && p.format == GL_DEPTH_STENCIL) {
		gls_unpack_stencil(&p, texels);
		place(l, gls_level_stencil(l), 1, at, size, texels);
	}
	take_missing(x, st, c, 4 + 2 * n_dims, l, is_whole(l, size));
	gls_texture_changed(t);
	gls_texture_level_changed(x, t, face, arg_i(c, 1));
}

/* ---- compressed images, sec. 3.8.3 ---- */

/* Decode a block-compressed image, slice by slice. @return 0, or -1 (counted) */
static int unpack_compressed(struct gls_exec *x, uint32_t internal_format, const int64_t size[3], const uint8_t *data,
                             size_t n, uint8_t *texels)
{
	for (int64_t z = 0; z < size[2]; z++)
		if (gls_decompress(internal_format, (uint32_t)size[0], (uint32_t)size[1],
		                   data + (size_t)z * (n / (size_t)size[2]), n / (size_t)size[2],
		                   texels + gls_texel_bytes(internal_format) * (size_t)(z * size[0] * size[1]))) {
			gls_unsupported(x, "compressed images of this format");
			return -1;
		}
	return 0;
}

static void compressed_image(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n_dims)
{
	unsigned face;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	const struct gls_level_form form = form_of(c, n_dims);
	struct gls_level *l;
	size_t n;
	const uint8_t *pixels = gls_pixel_source(st, c, n_dims + 5, &n);
	const uint32_t wrong = gls_compressed_error(form.internal_format,
	                                            (int64_t[3]){ form.width, form.height, form.depth }, form.border,
	                                            arg_i(c, 4 + n_dims));

	if (!t || gls_refuses_by(x, st, wrong))
		return;
	l = gls_texture_specify(x, st, t, face, arg_i(c, 1), &form);
	if (l)
		take_missing(x, st, c, n_dims + 5, l, 0);
	if (l && pixels)
		unpack_compressed(x, l->internal_format, (int64_t[3]){ l->width, l->height, l->depth }, pixels, n, l->texels);
	if (l)
		gls_texture_level_changed(x, t, face, arg_i(c, 1));
}

/* Load a level of a paletted image. first: number of texels in the levels before it */
static void load_paletted(struct gls_exec *x, struct gls_state *st, const struct gls_palette *palette,
                          struct gls_level *l, const uint8_t *data, size_t n, size_t first)
{
	const struct gls_pixel_store tight = { .alignment = 1 };
	const size_t count = (size_t)l->width * l->height, bytes = count * palette->entry_bytes;
	uint8_t *entries = gls_scratch(x, bytes);

	if (!entries)
		return;
	if (gls_palette_expand(palette, data, n, first, count, entries)) {
		gls_unsupported(x, "pixels beyond what the recording holds");
		return;
	}
	gls_unpack_pixels(x, st, &(struct gls_pixels){ .format = palette->format, .type = palette->type, .width = l->width,
	                                               .height = l->height, .data = entries, .n = bytes, .store = &tight },
	                  l->internal_format, l->texels);
}

/* Load levels 0 to -level together (OES_compressed_paletted_texture). */
static void paletted_images(struct gls_exec *x, struct gls_state *st, const struct call *c,
                            const struct gls_palette *palette)
{
	unsigned face;
	const int64_t last = -arg_i(c, 1);
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), last, &face);
	struct gls_level_form form = { palette->internal_format, arg_i(c, 3), arg_i(c, 4), 1, arg_i(c, 5) };
	size_t n, first = 0;
	const uint8_t *data = gls_pixel_source(st, c, 7, &n);

	for (int64_t level = 0; t && level <= last; level++) {
		struct gls_level *l = gls_texture_specify(x, st, t, face, level, &form);

		if (!l)
			return;
		take_missing(x, st, c, 7, l, 0);
		if (data)
			load_paletted(x, st, palette, l, data, n, first);
		gls_texture_level_changed(x, t, face, level);
		first += (size_t)l->width * l->height;
		first += palette->index_bits == 4 ? first % 2 : 0;
		form.width = form.width > 1 ? form.width / 2 : 1;
		form.height = form.height > 1 ? form.height / 2 : 1;
	}
}

GLS_FAMILY(glCompressedTexImage, STATE)
{
	const unsigned n_dims = gls_commands[x->command].suffix.n;
	struct gls_palette palette;

	if (n_dims == 2 && gls_palette_of(arg_u(c, 2), &palette))
		paletted_images(x, st, c, &palette);
	else
		compressed_image(x, st, c, n_dims);
}

GLS_FAMILY(glCompressedTexSubImage, STATE)
{
	const unsigned n_dims = gls_commands[x->command].suffix.n;
	unsigned face;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	struct gls_level *l = t ? &t->levels[face][arg_i(c, 1)] : NULL;
	int64_t at[3] = { 0 }, size[3] = { 1, 1, 1 };
	size_t n;
	const uint8_t *pixels = gls_pixel_source(st, c, 4 + 2 * n_dims, &n);
	uint8_t *texels;

	if (!l || !pixels)
		return;
	for (unsigned i = 0; i < n_dims; i++) {
		at[i] = arg_i32(c, 2 + i);
		size[i] = arg_i32(c, 2 + n_dims + i);
	}
	if (gls_refuses(x, st,
	                !l->texels || l->internal_format != arg_u(c, 2 + 2 * n_dims) || !gls_part_is_whole(l, at, size),
	                GL_INVALID_OPERATION))
		return;
	for (unsigned i = 0; i < 3; i++)
		if (at[i] < 0 || size[i] < 0 || at[i] + size[i] > (i == 0 ? l->width : i == 1 ? l->height : l->depth)) {
			gls_error(x, st, GL_INVALID_VALUE);
			return;
		}
	if (!size[0] || !size[1] || !size[2])
		return;
	texels = gls_scratch(x, (size_t)(size[0] * size[1] * size[2]) * l->texel_bytes);
	if (texels && !unpack_compressed(x, l->internal_format, size, pixels, n, texels))
		place(l, l->texels, l->texel_bytes, at, size, texels);
	take_missing(x, st, c, 4 + 2 * n_dims, l, is_whole(l, size));
	gls_texture_changed(t);
	gls_texture_level_changed(x, t, face, arg_i(c, 1));
}

/* ---- ARB_texture_storage: all levels at once, without texels ---- */

/* The size of a level along one side, at least 1. */
static int64_t side(const struct call *c, unsigned i, int64_t level)
{
	return arg_i(c, i) >> level ? arg_i(c, i) >> level : 1;
}

GLS_FAMILY(glTexStorage, STATE)
{
	const unsigned n_dims = gls_commands[x->command].suffix.n;
	unsigned face, n_faces = arg_u(c, 0) == GL_TEXTURE_CUBE_MAP ? 6 : 1;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), 0, &face);

	for (int64_t level = 0; t && level < arg_i(c, 1) && level < GLS_MAX_LEVELS; level++)
		for (face = 0; face < n_faces; face++)
			gls_texture_specify(x, st, t, face, level,
			                    &(struct gls_level_form){ arg_u(c, 2), side(c, 3, level), n_dims > 1 ? side(c, 4, level) : 1,
			                                              n_dims > 2 ? side(c, 5, level) : 1, 0 });
}

/* ---- ARB_clear_texture: fills a level with one pixel, in TexImage's format ---- */

GLS_HANDLER(glClearTexImage, OBJECT)
{
	const struct gls_pixel_store tight = { .alignment = 1, .swap_bytes = gls_client_store(x, st)->swap_bytes };
	struct gls_pixels pixel = { .format = arg_u(c, 2), .type = arg_u(c, 3), .width = 1, .height = 1, .store = &tight };
	struct gls_texture *t = table_find(&st->share->textures, arg_u(c, 0));
	uint8_t texel[16] = { 0 };

	if (gls_refuses(x, st, !t || arg_i(c, 1) < 0 || arg_i(c, 1) >= GLS_MAX_LEVELS, GL_INVALID_OPERATION))
		return;
	gls_texture_update(x, st, t);
	pixel.data = arg_blob(c, 4, &pixel.n);
	for (unsigned face = 0; face < 6; face++) {
		struct gls_level *l = &t->levels[face][arg_i(c, 1)];

		if (!l->texels)
			continue;
		if (pixel.data)
			gls_unpack_pixels(x, st, &pixel, l->internal_format, texel);
		for (size_t i = 0; i < gls_level_count(l); i++)
			memcpy(l->texels + l->texel_bytes * i, texel, l->texel_bytes);
		gls_texture_changed(t);
	}
}

/* ---- ARB_copy_image, NV_copy_image: copies of raw texels, slice by slice ---- */

/* The image of a texture's level that contains place z, and the slice within it. NULL: there is none. */
static struct gls_level *slice_of(struct gls_texture *t, int64_t level, int64_t z, size_t *slice)
{
	int cube = t && t->target == GLS_TEXTURE_CUBE;
	struct gls_level *l;

	if (!t || level < 0 || level >= GLS_MAX_LEVELS || z < 0 || (cube && z > 5))
		return NULL;
	l = &t->levels[cube ? z : 0][level];
	*slice = cube ? 0 : (size_t)z;
	return l->texels && *slice < l->depth ? l : NULL;
}

static int is_inside(const struct gls_level *l, int64_t x, int64_t y, int64_t width, int64_t height)
{
	return x >= 0 && y >= 0 && x <= l->width && y <= l->height && width <= l->width - x && height <= l->height - y;
}

static void copy_image(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	struct gls_texture *from = table_find(&st->share->textures, arg_u(c, 0)),
			   *to = table_find(&st->share->textures, arg_u(c, 6));
	int64_t width = arg_i(c, 12), height = arg_i(c, 13);

	if (arg_u(c, 1) == GL_RENDERBUFFER || arg_u(c, 7) == GL_RENDERBUFFER) {
		gls_unsupported(x, "copies of renderbuffers");
		return;
	}
	gls_texture_update(x, st, from);
	gls_texture_update(x, st, to);
	for (int64_t z = 0; z < arg_i(c, 14); z++) {
		size_t slice[2];
		struct gls_level *a = slice_of(from, arg_i(c, 2), arg_i(c, 5) + z, &slice[0]);
		struct gls_level *b = slice_of(to, arg_i(c, 8), arg_i(c, 11) + z, &slice[1]);

		if (!a || !b || width < 0 || height < 0 || !is_inside(a, arg_i(c, 3), arg_i(c, 4), width, height) ||
		    !is_inside(b, arg_i(c, 9), arg_i(c, 10), width, height)) {
			gls_error(x, st, GL_INVALID_VALUE);
			return;
		}
		if (a->internal_format != b->internal_format) {
			gls_unsupported(x, "copies between internal formats");
			return;
		}
		for (int64_t y = 0; y < height; y++) {
			size_t i = (slice[0] * a->height + (size_t)(arg_i(c, 4) + y)) * a->width + (size_t)arg_i(c, 3);
			size_t k = (slice[1] * b->height + (size_t)(arg_i(c, 10) + y)) * b->width + (size_t)arg_i(c, 9);

			memmove(b->texels + b->texel_bytes * k, a->texels + a->texel_bytes * i, b->texel_bytes * (size_t)width);
			if (gls_level_stencil(b))
				memmove(gls_level_stencil(b) + k, gls_level_stencil(a) + i, (size_t)width);
		}
		if (a->missing)
			gls_level_lose(b, a->missing);
		gls_texture_changed(to);
	}
}

GLS_HANDLER(glCopyImageSubData, OBJECT) { copy_image(x, st, c); }
GLS_HANDLER(glCopyImageSubDataNV, OBJECT) { copy_image(x, st, c); }

GLS_HANDLER(glGenerateMipmap, STATE)
{
	unsigned face;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), 0, &face);

	if (!t || gls_refuses(x, st, arg_u(c, 0) == GL_TEXTURE_RECTANGLE, GL_INVALID_ENUM))
		return;
	for (face = 0; face < (t->target == GLS_TEXTURE_CUBE ? 6u : 1u); face++)
		gls_texture_generate_mipmaps(x, t, face);
	gls_texture_changed(t);
}
