/* Conversion of client pixels to texels. */
#include "replay/gl/texture/unpack.h"

#include <string.h>

#include "gl_tokens.h"
#include "base/half.h"
#include "base/norm.h"
#include "capture/format/call.h"
#include "capture/format/sizes.h"
#include "replay/gl/texture/clientformat.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/transfer.h"
#include "replay/gl/texture/ycbcr.h"
#include "replay/machine/args.h"
#include "replay/machine/buffer.h"
#include "replay/machine/errors.h"
#include "replay/machine/state.h"

static uint32_t load(const uint8_t *p, size_t n, int swap)
{
	uint32_t value = 0;

	for (size_t i = 0; i < n; i++)
		value |= (uint32_t)p[swap ? n - 1 - i : i] << (8 * i);
	return value;
}

/* One component as a float (table 2.9); for packed depth and stencil the depth. */
static float plain_component(const uint8_t *p, uint32_t type, int swap)
{
	size_t bytes = gls_component_bytes(type);
	uint32_t u = load(p, bytes < 4 ? bytes : 4, swap);
	float f;

	switch (type) {
	case GL_HALF_FLOAT:
		return half_to_float((uint16_t)u);
	case GL_UNSIGNED_INT_24_8:
		return (float)(u >> 8) / 16777215.0f;
	case GL_UNSIGNED_BYTE:
		return (float)u / 255.0f;
	case GL_BYTE:
		return (2.0f * (int8_t)u + 1) / 255.0f;
	case GL_UNSIGNED_SHORT:
		return (float)u / 65535.0f;
	case GL_SHORT:
		return (2.0f * (int16_t)u + 1) / 65535.0f;
	case GL_UNSIGNED_INT:
		return (float)(u / 4294967295.0);
	case GL_INT:
		return norm_int((int32_t)u);
	default:
		memcpy(&f, &u, 4);
		return f;
	}
}

static void packed_components(const uint8_t *p, const struct gls_packed *t, int swap, float out[4])
{
	uint32_t word = load(p, t->bytes, swap);
	unsigned shift = t->reversed ? 0 : 8 * t->bytes;

	for (unsigned i = 0; i < t->n; i++) {
		uint32_t max = (1u << t->bits[i]) - 1;
		if (!t->reversed)
			shift -= t->bits[i];
		out[i] = (float)(word >> shift & max) / (float)max;
		if (t->reversed)
			shift += t->bits[i];
	}
}

/* ---- memory layout ---- */

size_t gls_pixel_bytes(const struct gls_pixel_store *s, const struct pixel_box *box)
{
	const struct pixel_layout layout = { s->row_length,  s->image_height, s->skip_rows,
		                             s->skip_pixels, s->skip_images,  s->alignment };

	return (size_t)image_bytes(&layout, box);
}

const uint8_t *gls_pixel_source(struct gls_state *st, const struct call *c, unsigned i, size_t *n)
{
	const struct gls_buffer *b = gls_buffer_find(st, st->client.unpack.buffer);
	uint64_t offset = (uint64_t)arg_i(c, i);

	if (arg(c, i)->type == TRACE_BLOB)
		return arg_blob(c, i, n);
	*n = 0;
	if (!b || offset >= b->bytes)
		return NULL;
	*n = b->bytes - offset;
	return b->data + offset;
}

/* Number of pixels in a row in memory. */
static size_t row_pixels(const struct gls_pixels *p)
{
	return p->store->row_length > 0 ? (size_t)p->store->row_length : p->width;
}

/* Rows begin at multiples of the alignment (sec. 3.6.4, equation 3.13). */
static size_t aligned(const struct gls_pixels *p, size_t row)
{
	size_t alignment = (size_t)p->store->alignment;

	return (row + alignment - 1) / alignment * alignment;
}

/* Offset of a pixel in a 2D image. group: size of a pixel in bytes */
static size_t place_of(const struct gls_pixels *p, size_t group, uint32_t x, uint32_t y)
{
	const struct gls_pixel_store *s = p->store;

	return ((size_t)s->skip_rows + y) * aligned(p, group * row_pixels(p)) + ((size_t)s->skip_pixels + x) * group;
}

int gls_unpack_bit(const struct gls_pixels *p, uint32_t x, uint32_t y)
{
	const struct gls_pixel_store *s = p->store;
	size_t bit = (size_t)s->skip_pixels + x,
	       at = ((size_t)s->skip_rows + y) * aligned(p, (row_pixels(p) + 7) / 8) + bit / 8;

	return at < p->n && p->data[at] >> (s->lsb_first ? bit & 7 : 7 - (bit & 7)) & 1;
}

uint32_t gls_pixel_missing(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned i)
{
	return arg(c, i)->type == TRACE_BLOB ? 0 : gls_buffer_lacks(x, gls_buffer_find(st, st->client.unpack.buffer));
}

/* ---- stencil values and indices ---- */

void gls_unpack_stencil(const struct gls_pixels *p, uint8_t *out)
{
	size_t group = gls_component_bytes(p->type);

	for (uint32_t y = 0; y < p->height * (p->depth ? p->depth : 1); y++)
		for (uint32_t x = 0; x < p->width; x++) {
			size_t at = place_of(p, group, x, y);

			/* the lowest byte of the last word, if there is a word */
			*out++ = group >= 4 && at <= p->n && group <= p->n - at ? p->data[at + group - (p->store->swap_bytes ? 1 : 4)] : 0;
		}
}

/* A colour or stencil index, shifted and offset. size: its size in bytes, unless it is a bit */
static uint32_t index_at(const struct gls_state *st, const struct gls_pixels *p, size_t size, uint32_t x, uint32_t y)
{
	size_t at = place_of(p, size, x, y);
	uint32_t value = 0;
	float f;

	if (p->type == GL_BITMAP)
		value = (uint32_t)gls_unpack_bit(p, x, y);
	else if (at + size <= p->n)
		value = load(p->data + at, size, p->store->swap_bytes);
	if (p->type == GL_FLOAT) {
		memcpy(&f, &value, 4);
		value = token_of_float(f);
	}
	return p->drawn ? value : gls_transfer_index(st, value);
}

int gls_unpack_indices(const struct gls_state *st, const struct gls_pixels *p, uint8_t *out)
{
	size_t size = gls_component_bytes(p->type);

	if (p->type == GL_HALF_FLOAT || p->type == GL_UNSIGNED_INT_24_8 || p->type == GL_FLOAT_32_UNSIGNED_INT_24_8_REV ||
	    (p->type != GL_BITMAP && !size))
		return -1;
	for (uint32_t y = 0; y < p->height * (p->depth ? p->depth : 1); y++)
		for (uint32_t x = 0; x < p->width; x++, out += 4) {
			uint32_t value = index_at(st, p, size, x, y);

			if (p->format == GL_STENCIL_INDEX) {
				value = gls_transfer_stencil(st, value);
				memcpy(out, &value, 4);
			} else {
				gls_transfer_color_index(st, value, out);
			}
		}
	return 0;
}

/* ---- bytes and floats that pixel transfer does not change ---- */

/* These are only rearranged. For each of a texel's four bytes: the number of a pixel's component, or one of these. */
enum { ZERO_BYTE = 4, FULL_BYTE };

static void places_of(const struct gls_client_format *f, uint32_t base, uint8_t place[4])
{
	place[0] = place[1] = place[2] = ZERO_BYTE;
	place[3] = FULL_BYTE;
	for (unsigned k = 0; k < f->n; k++) {
		if (f->to[k] == 4)
			place[0] = place[1] = place[2] = (uint8_t)k;
		else
			place[f->to[k]] = (uint8_t)k;
	}
	if (base == GL_ALPHA)
		place[0] = place[1] = place[2] = ZERO_BYTE;
	if (base == GL_LUMINANCE || base == GL_LUMINANCE_ALPHA || base == GL_INTENSITY)
		place[1] = place[2] = place[0];
	if (base == GL_RED || base == GL_RG)
		place[2] = ZERO_BYTE;
	if (base == GL_RED)
		place[1] = ZERO_BYTE;
	if (base == GL_LUMINANCE || base == GL_RGB || base == GL_RED || base == GL_RG)
		place[3] = FULL_BYTE;
	if (base == GL_INTENSITY)
		place[3] = place[0];
}

/* Places as factors: a component times its factor appears in all its places in a texel; `rest` has the other bytes. */
struct spread {
	uint32_t member[4], rest;
};

static struct spread spread_of(const uint8_t place[4])
{
	uint8_t bytes[5][4] = { { 0 } };
	struct spread s;

	for (unsigned k = 0; k < 4; k++) {
		if (place[k] < ZERO_BYTE)
			bytes[place[k]][k] = 1;
		bytes[4][k] = place[k] == FULL_BYTE ? 255 : 0;
	}
	memcpy(s.member, bytes, sizeof(s.member));
	memcpy(&s.rest, bytes[4], sizeof(s.rest));
	return s;
}

static inline void place_bytes(const uint8_t *from, unsigned n, uint32_t width, const uint8_t place[4], uint8_t *out)
{
	const struct spread s = spread_of(place);

	for (uint32_t i = 0; i < width; i++, from += n, out += 4) {
		uint32_t texel = s.rest;

		for (unsigned k = 0; k < n; k++)
			texel += from[k] * s.member[k];
		memcpy(out, &texel, 4);
	}
}

static inline void place_floats(const uint8_t *from, unsigned n, uint32_t width, const uint8_t place[4], uint8_t *out)
{
	const struct spread s = spread_of(place);
	float values[4];

	for (uint32_t i = 0; i < width; i++, from += 4 * n, out += 4) {
		uint32_t texel = s.rest;

		memcpy(values, from, 4 * n);
		for (unsigned k = 0; k < n; k++)
			texel += gls_byte(values[k]) * s.member[k];
		memcpy(out, &texel, 4);
	}
}

static void unpack_floats(const uint8_t *from, unsigned n, uint32_t width, const uint8_t place[4], uint8_t *out)
{
	if (n == 4)
		place_floats(from, 4, width, place, out);
	else if (n == 3)
		place_floats(from, 3, width, place, out);
	else if (n == 2)
		place_floats(from, 2, width, place, out);
	else
		place_floats(from, 1, width, place, out);
}

static void unpack_bytes(const uint8_t *from, unsigned n, uint32_t width, const uint8_t place[4], uint8_t *out)
{
	static const uint8_t as_they_are[4] = { 0, 1, 2, 3 };

	if (n == 4 && memcmp(place, as_they_are, 4) == 0)
		memcpy(out, from, 4 * (size_t)width);
	else if (n == 4)
		place_bytes(from, 4, width, place, out);
	else if (n == 3)
		place_bytes(from, 3, width, place, out);
	else if (n == 2)
		place_bytes(from, 2, width, place, out);
	else
		place_bytes(from, 1, width, place, out);
}

/* ---- any pixels ---- */

/* The source and destination formats of a command's pixels. */
struct unpacking {
	const struct gls_state *st;
	const struct gls_pixels *p;
	const struct gls_client_format *from;
	const struct gls_packed *packed; /* NULL: each component has bytes of its own */
	size_t component, group;     /* size in bytes of a component, of a pixel */
	const struct gls_format *to;
	size_t step;                 /* size in bytes of a texel */
	int transfers, is_depth;
	int is_plain;                /* 1: components are only rearranged: */
	uint8_t place[4];
	int ycbcr;                   /* 1: luma is byte `low` of each pair */
	unsigned low;
};

/*
 * Pixels in luma, where each two share a colour (MESA_ycbcr_texture); pixel transfer does not change them. @return 0:
 * not one of these types
 */
static int describe_ycbcr(struct unpacking *u)
{
	const uint32_t type = u->p->type;

	u->group = 2;
	u->step = 4;
	u->ycbcr = 1;
	u->low = !((type == GL_UNSIGNED_SHORT_8_8_REV_MESA) ^ (u->p->store->swap_bytes != 0));
	return u->to->token == GL_YCBCR_MESA && (type == GL_UNSIGNED_SHORT_8_8_MESA || type == GL_UNSIGNED_SHORT_8_8_REV_MESA);
}

/* @return 0: unsupported format and type */
static int describe(struct unpacking *u)
{
	const struct gls_pixels *p = u->p;
	const struct gls_format *to = u->to;
	const int is_packed_depth = p->type == GL_UNSIGNED_INT_24_8 || p->type == GL_FLOAT_32_UNSIGNED_INT_24_8_REV;

	if (p->format == GL_YCBCR_MESA)
		return describe_ycbcr(u);
	u->from = gls_client_format_find(p->format);
	u->packed = gls_packed_find(p->type);
	u->component = gls_component_bytes(p->type);
	u->is_depth = to->base == GL_DEPTH_COMPONENT;
	if (!u->from || (!u->component && !u->packed) || u->is_depth != (u->from->to[0] == 5) ||
	    (u->packed && u->packed->n != u->from->n) || (p->format == GL_DEPTH_STENCIL) != is_packed_depth)
		return 0;
	u->group = u->packed ? u->packed->bytes : u->from->n * u->component;
	u->step = to->numbers ? 16 : 4;
	u->transfers = gls_transfer_changes_colors(u->st);
	u->is_plain = (p->type == GL_UNSIGNED_BYTE || (p->type == GL_FLOAT && !p->store->swap_bytes)) && !u->transfers &&
	              !u->is_depth && !to->bits[0] && !to->bits[3] && !to->numbers;
	if (u->is_plain)
		places_of(u->from, to->base, u->place);
	return 1;
}

static void unpack_texel(const struct unpacking *u, const uint8_t *data, uint8_t *out)
{
	const struct gls_client_format *f = u->from;
	float rgba[4] = { 0, 0, 0, 1 }, v[4];

	if (u->packed)
		packed_components(data, u->packed, u->p->store->swap_bytes, v);
	else
		for (unsigned k = 0; k < f->n; k++)
			v[k] = plain_component(data + k * u->component, u->p->type, u->p->store->swap_bytes);
	if (u->is_depth) {
		v[0] = gls_transfer_depth(u->p->drawn && u->p->type == GL_FLOAT ? NULL : u->st, v[0]);
		memcpy(out, v, 4);
		return;
	}
	for (unsigned k = 0; k < f->n; k++) {
		if (f->to[k] == 4)
			rgba[0] = rgba[1] = rgba[2] = v[k];
		else
			rgba[f->to[k]] = v[k];
	}
	if (u->transfers)
		gls_transfer_color(u->st, (int)u->p->drawn, rgba);
	gls_format_store(u->to, rgba, u->st->mesa, out);
}

/* @return 0, or -2: some bytes are not available */
static int unpack_row(const struct unpacking *u, size_t at, uint8_t *out)
{
	size_t n = u->p->n;
	int rc = 0;

	for (uint32_t i = 0; u->ycbcr && i < u->p->width; i++)
		rc |= gls_ycbcr_texel(u->p->data + (at < n ? at : n), at < n ? n - at : 0, i, u->low, out + 4 * i);
	if (u->ycbcr)
		return rc;
	if (u->is_plain && at <= n && u->group * u->p->width <= n - at) {
		(u->p->type == GL_FLOAT ? unpack_floats : unpack_bytes)(u->p->data + at, u->from->n, u->p->width, u->place, out);
		return 0;
	}
	for (uint32_t i = 0; i < u->p->width; i++, at += u->group, out += u->step) {
		if (at <= n && u->group <= n - at) {
			unpack_texel(u, u->p->data + at, out);
		} else {
			memset(out, 0, u->step);
			rc = -2;
		}
	}
	return rc;
}

/* Convert colour indices to colours through the maps (sec. 3.6.5). @return 0, or -1: not a type of indices */
static int unpack_color_indices(const struct gls_state *st, const struct gls_pixels *p, const struct gls_format *to,
                                uint8_t *out)
{
	if (gls_unpack_indices(st, p, out))
		return -1;
	/* backwards, because texels may be larger than colours */
	for (size_t i = (size_t)p->width * p->height * (p->depth ? p->depth : 1); i-- > 0;) {
		float v[4];

		gls_texel_load(4, out + 4 * i, v);
		gls_format_store(to, v, st->mesa, out + (to->numbers ? 16 : 4) * i);
	}
	return 0;
}

int gls_unpack_pixels(struct gls_exec *x, const struct gls_state *st, const struct gls_pixels *p,
                      uint32_t internal_format, uint8_t *out)
{
	const struct gls_pixel_store *s = p->store;
	struct unpacking u = { .st = st, .p = p, .to = gls_format_find(internal_format) };
	size_t row, image, start;
	int rc = 0;

	if (p->format == GL_COLOR_INDEX && u.to->base != GL_DEPTH_COMPONENT) {
		if (!unpack_color_indices(st, p, u.to, out))
			return 0;
	} else if (describe(&u)) {
		row = aligned(p, u.group * row_pixels(p));
		image = row * (s->image_height > 0 ? (size_t)s->image_height : p->height);
		start = (p->depth ? (size_t)s->skip_images * image : 0) + place_of(p, u.group, 0, 0);
		for (uint32_t z = 0; z < (p->depth ? p->depth : 1); z++)
			for (uint32_t y = 0; y < p->height; y++, out += u.step * p->width)
				rc |= unpack_row(&u, start + z * image + y * row, out);
		return rc;
	}
	gls_unsupported(x, "pixels of this format and type");
	return -1;
}
