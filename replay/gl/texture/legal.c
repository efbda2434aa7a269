#include "replay/gl/texture/legal.h"

#include <stddef.h>

#include "gl_tokens.h"
#include "replay/gl/texture/clientformat.h"
#include "replay/gl/texture/level.h"
#include "replay/gl/texture/texformat.h"
#include "scene/mesa.h"

static int is_index(uint32_t format)
{
	return format == GL_COLOR_INDEX || format == GL_STENCIL_INDEX;
}

/* Formats of EXT_texture_integer: fixed function cannot show them, so they are not checked further. */
static int is_integer(uint32_t format)
{
	return (format >= GL_RED_INTEGER && format <= GL_BGRA_INTEGER) || format == GL_RG_INTEGER ||
	       (format >= GL_LUMINANCE_INTEGER_EXT && format <= GL_LUMINANCE_ALPHA_INTEGER_EXT);
}

/* 1 for types that pack a pixel into one word. */
static int is_packed(uint32_t type)
{
	switch (type) {
	case GL_UNSIGNED_INT_24_8:
	case GL_FLOAT_32_UNSIGNED_INT_24_8_REV:
	case GL_UNSIGNED_SHORT_8_8_MESA:
	case GL_UNSIGNED_SHORT_8_8_REV_MESA:
	case GL_UNSIGNED_INT_10F_11F_11F_REV: case GL_UNSIGNED_INT_5_9_9_9_REV:
		return 1;
	default:
		return gls_packed_find(type) != NULL;
	}
}

/* 1 if pixels of a format can have a packed type. */
static int goes_with(uint32_t format, uint32_t type)
{
	const struct gls_client_format *f = gls_client_format_find(format);
	const struct gls_packed *packed = gls_packed_find(type);

	switch (type) {
	case GL_UNSIGNED_INT_24_8: case GL_FLOAT_32_UNSIGNED_INT_24_8_REV:
		return format == GL_DEPTH_STENCIL;
	case GL_UNSIGNED_SHORT_8_8_MESA: case GL_UNSIGNED_SHORT_8_8_REV_MESA:
		return format == GL_YCBCR_MESA;
	case GL_UNSIGNED_INT_2_10_10_10_REV: /* valid for RGB as well, with the two bits ignored */
		return format == GL_RGB || (f && f->n == 4);
	default:
		return packed && packed->n == 4 ? f && f->n == 4 : format == GL_RGB;
	}
}

static int is_plain(uint32_t type)
{
	return (type >= GL_BYTE && type <= GL_FLOAT) || type == GL_HALF_FLOAT || type == GL_HALF_FLOAT_OES;
}

static int is_format(uint32_t format, uint32_t mesa)
{
	return gls_client_format_find(format) || is_index(format) ||
	       (format == GL_YCBCR_MESA && !(mesa & SCENE_MESA_LACKS_YCBCR));
}

uint32_t gls_pixels_error(uint32_t format, uint32_t type, uint32_t mesa)
{
	if (is_integer(format))
		return 0;
	if (!is_format(format, mesa) || (type == GL_BITMAP && !is_index(format)) ||
	    (!is_packed(type) && !is_plain(type) && type != GL_BITMAP))
		return GL_INVALID_ENUM;
	if (is_packed(type))
		return goes_with(format, type) ? 0 : GL_INVALID_OPERATION;
	return format == GL_DEPTH_STENCIL || format == GL_YCBCR_MESA ? GL_INVALID_ENUM : 0;
}

static int has_depth(uint32_t format)
{
	return format == GL_DEPTH_COMPONENT || format == GL_DEPTH_STENCIL;
}

int gls_formats_agree(uint32_t internal_format, uint32_t format)
{
	const uint32_t base = gls_base_format(internal_format);

	if (!base || is_integer(format) || format == GL_YCBCR_MESA || base == GL_STENCIL_INDEX)
		return 1;
	return has_depth(base) ? has_depth(format) : !has_depth(format) && format != GL_STENCIL_INDEX;
}

static int is_face(uint32_t target)
{
	return target >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && target <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z;
}

int gls_takes_target(unsigned n_dims, uint32_t target)
{
	if (n_dims == 1)
		return target == GL_TEXTURE_1D;
	if (n_dims == 2)
		return target == GL_TEXTURE_2D || target == GL_TEXTURE_RECTANGLE || target == GL_TEXTURE_1D_ARRAY || is_face(target);
	return target == GL_TEXTURE_3D || target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_CUBE_MAP_ARRAY;
}

uint32_t gls_image_error(uint32_t target, uint32_t internal_format, int64_t level, const int64_t size[2],
                         int64_t border, uint32_t mesa)
{
	const uint32_t base = gls_base_format(internal_format);

	/* 1 to 4 are numbers of components; tokens begin at GL_COLOR_INDEX. */
	if ((internal_format - 1u > 3u && internal_format < GL_COLOR_INDEX) || (is_face(target) && size[0] != size[1]) ||
	    (target == GL_TEXTURE_RECTANGLE && (level || border)) ||
	    (internal_format == GL_YCBCR_MESA && mesa & SCENE_MESA_LACKS_YCBCR))
		return GL_INVALID_VALUE;
	return target == GL_TEXTURE_3D && has_depth(base) ? GL_INVALID_OPERATION : 0;
}

/* Images of this size or more cannot be created; products of smaller sizes fit in 64 bits. */
#define MOST_SIDE ((int64_t)1 << 19)

uint32_t gls_compressed_error(uint32_t internal_format, const int64_t size[3], int64_t border, int64_t n_bytes)
{
	const struct gls_format *f = gls_format_find(internal_format);
	int64_t across;

	if (!f)
		return 0; /* counted where it is read */
	if (!f->block_bytes)
		return GL_INVALID_ENUM;
	for (unsigned i = 0; i < 3; i++)
		if (size[i] < 0 || size[i] > MOST_SIDE)
			return GL_INVALID_VALUE;
	across = gls_block_width(f);
	if (n_bytes != (size[0] + across - 1) / across * ((size[1] + 3) / 4) * size[2] * f->block_bytes)
		return GL_INVALID_VALUE;
	return border ? GL_INVALID_OPERATION : 0;
}

int gls_part_is_whole(const struct gls_level *l, const int64_t at[2], const int64_t size[2])
{
	const struct gls_format *f = gls_format_find(l->internal_format);
	int64_t across;

	if (!f || !f->block_bytes)
		return 1;
	across = gls_block_width(f);
	return at[0] % across == 0 && at[1] % 4 == 0 && (size[0] % across == 0 || at[0] + size[0] == l->width) &&
	       (size[1] % 4 == 0 || at[1] + size[1] == l->height);
}
