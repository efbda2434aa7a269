#include "replay/gl/texture/pack.h"

#include <half.h>
#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "replay/machine/state.h"

/* ---- layout ---- */

int gls_packing_find(uint32_t format, uint32_t type, struct gls_packing *p)
{
	const int is_both = type == GL_UNSIGNED_INT_24_8 || type == GL_FLOAT_32_UNSIGNED_INT_24_8_REV;

	*p = (struct gls_packing){ .format = format, .type = type, .colors = gls_client_format_find(format),
		.packed = gls_packed_find(type), .component = gls_component_bytes(type) };
	if (!p->colors && format != GL_STENCIL_INDEX)
		return 0;
	if ((!p->component && !p->packed) || (format == GL_DEPTH_STENCIL) != is_both ||
	    (p->packed && (!p->colors || p->packed->n != p->colors->n)))
		return 0;
	p->group = p->packed ? p->packed->bytes : (p->colors ? p->colors->n : 1) * p->component;
	return !(format == GL_STENCIL_INDEX && type == GL_HALF_FLOAT);
}

/* No buffer is larger than this, so that no sum below exceeds 64 bits. */
#define MOST ((uint64_t)INT32_MAX)

int gls_packing_lay(struct gls_packing *p, const struct gls_pixel_store *store, const uint32_t size[3], uint64_t offset,
                    uint64_t bytes)
{
	const uint64_t alignment = (uint64_t)store->alignment,
		       row_pixels = store->row_length > 0 ? (uint64_t)store->row_length : size[0];
	const uint64_t rows = size[2] && store->image_height > 0 ? (uint64_t)store->image_height : size[1];
	const uint64_t skip_images = size[2] ? (uint64_t)store->skip_images : 0,
		       images = skip_images + (size[2] ? size[2] - 1 : 0);

	p->swap = store->swap_bytes;
	p->row = (p->group * row_pixels + alignment - 1) / alignment * alignment;
	if (p->row > MOST || offset > bytes || bytes > MOST)
		return 0;
	p->image = p->row * rows;
	if (p->image > MOST && images)
		return 0;
	p->start = offset + skip_images * p->image + (uint64_t)store->skip_rows * p->row +
	           (uint64_t)store->skip_pixels * p->group;
	p->end = p->start + (images - skip_images) * p->image + (uint64_t)(size[1] - 1) * p->row +
	         (uint64_t)size[0] * p->group;
	return p->start <= p->end && p->end <= bytes; /* a damaged snapshot may hold any numbers */
}

static void store(const struct gls_packing *p, uint32_t value, size_t n, uint8_t *to)
{
	for (size_t i = 0; i < n; i++)
		to[p->swap ? n - 1 - i : i] = (uint8_t)(value >> (8 * i));
}

static void store_float(const struct gls_packing *p, float value, uint8_t *to)
{
	uint32_t bits;

	memcpy(&bits, &value, 4);
	store(p, bits, 4, to);
}

/* ---- colours ---- */

static float clamp(float v, float least)
{
	return v > least ? v < 1 ? v : 1 : least;
}

/*
 * A 32-bit integer. Mesa scales a float by the largest integer as a float, so that 1 overflows: the result is 0, or the
 * minimum.
 */
static uint32_t long_number(float v, int is_signed, int bytes)
{
	const double most = is_signed ? INT32_MAX : UINT32_MAX;

	if (bytes)
		return (uint32_t)(int64_t)rint(rint((double)v * 255) / 255 * most);
	if (v > 1)
		return is_signed ? INT32_MAX : UINT32_MAX;
	return (uint32_t)(int64_t)rintf(clamp(v, is_signed ? -1 : 0) * (float)most);
}

static void pack_component(const struct gls_packing *p, float v, int bytes, uint8_t *to)
{
	switch (p->type) {
	case GL_FLOAT:
		store_float(p, v, to);
		return;
	case GL_HALF_FLOAT:
		store(p, imath_float_to_half(v), 2, to);
		return;
	case GL_INT:
	case GL_UNSIGNED_INT:
		store(p, long_number(v, p->type == GL_INT, bytes), 4, to);
		return;
	case GL_BYTE:
	case GL_SHORT:
		store(p, (uint32_t)(int32_t)rintf(clamp(v, -1) * (p->type == GL_BYTE ? 127 : 32767)), p->component, to);
		return;
	default:
		store(p, (uint32_t)rintf(clamp(v, 0) * (p->type == GL_UNSIGNED_BYTE ? 255 : 65535)), p->component, to);
	}
}

void gls_pack_color(const struct gls_packing *p, const struct gls_packed_color *color, uint8_t *to)
{
	const float *rgba = color->rgba;
	const int is_grey = p->colors->to[0] == 4, sums = is_grey && !color->is_texel;
	unsigned shift = !p->packed || p->packed->reversed ? 0 : 8 * p->packed->bytes;
	uint32_t word = 0;

	for (unsigned k = 0; k < p->colors->n; k++) {
		const unsigned which = p->colors->to[k];
		float v = which < 4 ? rgba[which] : rgba[0];

		if (sums)
			v = which < 4 ? clamp(v, 0) : fminf(clamp(rgba[0], 0) + clamp(rgba[1], 0) + clamp(rgba[2], 0), 1);
		if (p->packed) {
			shift -= p->packed->reversed ? 0 : p->packed->bits[k];
			word |= (uint32_t)rintf(clamp(v, 0) * (float)((1u << p->packed->bits[k]) - 1)) << shift;
			shift += p->packed->reversed ? p->packed->bits[k] : 0;
		} else {
			pack_component(p, v, color->bytes && !sums && !(is_grey && p->type == GL_UNSIGNED_INT), to + k * p->component);
		}
	}
	if (p->packed)
		store(p, word, p->packed->bytes, to);
}

/* ---- depths and stencil values ---- */

/* Expand a stored depth to 32 bits by repeating its bits. */
static uint32_t long_depth(float depth, uint32_t steps, uint32_t bits)
{
	if (bits >= 16 && bits < 32)
		return steps << (32 - bits) | steps >> (2 * bits - 32);
	return (uint32_t)((double)depth * 4294967295.0);
}

void gls_pack_depth(const struct gls_packing *p, float depth, uint32_t steps, uint32_t bits, uint8_t stencil,
                    uint8_t *to)
{
	depth = clamp(depth, 0);
	switch (p->type) {
	case GL_UNSIGNED_BYTE:
		store(p, (uint32_t)(depth * 255), 1, to);
		return;
	case GL_BYTE:
		store(p, (uint32_t)(((int32_t)(depth * 255) - 1) / 2), 1, to);
		return;
	case GL_SHORT:
		store(p, (uint32_t)(((int32_t)(depth * 65535) - 1) / 2), 2, to);
		return;
	case GL_UNSIGNED_SHORT:
		store(p, (uint32_t)rintf(depth * 65535), 2, to);
		return;
	case GL_INT:
		store(p, (uint32_t)((double)depth * 2147483647.0), 4, to);
		return;
	case GL_UNSIGNED_INT:
		store(p, long_depth(depth, steps, bits), 4, to);
		return;
	case GL_UNSIGNED_INT_24_8:
		store(p, (bits == 24 ? steps : (uint32_t)((double)depth * 16777215.0)) << 8 | stencil, 4, to);
		return;
	case GL_HALF_FLOAT:
		store(p, imath_float_to_half(depth), 2, to);
		return;
	case GL_FLOAT_32_UNSIGNED_INT_24_8_REV:
		store(p, stencil, 4, to + 4);
		/* fall through */
	default:
		store_float(p, depth, to);
	}
}

void gls_pack_stencil(const struct gls_packing *p, uint8_t stencil, uint8_t *to)
{
	if (p->type == GL_FLOAT)
		store_float(p, stencil, to);
	else
		store(p, p->type == GL_BYTE ? stencil & 127u : stencil, p->component, to);
}
