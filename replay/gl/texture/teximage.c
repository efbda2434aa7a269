/* Pixels from the client into textures (GL 2.1 sec. 3.6, 3.8.1, 3.8.2, 3.8.8). */
#include "replay/gl/texture/teximage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "capture/format/trace.h"
#include "replay/gl/dispatch.h"
#include "replay/gl/geometry/buffer.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/surface/pixels.h"
#include "replay/gl/texture/texcompress.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/state.h"
#include "base/table.h"

#define MAX_SIZE 16384
#define MAX_BYTES ((int64_t)1 << 31) /* of an image: so many llvmpipe (Mesa 22.3) refuses */

/* ---- client formats, tables 3.5 and 3.6 ---- */

/* Which of R G B A each component of a group is; 4: luminance (all of RGB), 5: depth. */
struct format {
	uint32_t token;
	unsigned n;
	uint8_t to[4];
};

static const struct format *find_format(uint32_t token)
{
	static const struct format formats[] = {
		{ GL_RED, 1, { 0 } },         { GL_GREEN, 1, { 1 } },        { GL_BLUE, 1, { 2 } },
		{ GL_ALPHA, 1, { 3 } },       { GL_RGB, 3, { 0, 1, 2 } },    { GL_BGR, 3, { 2, 1, 0 } },
		{ GL_RGBA, 4, { 0, 1, 2, 3 } }, { GL_BGRA, 4, { 2, 1, 0, 3 } }, { GL_ABGR_EXT, 4, { 3, 2, 1, 0 } },
		{ GL_LUMINANCE, 1, { 4 } },   { GL_LUMINANCE_ALPHA, 2, { 4, 3 } }, { GL_DEPTH_COMPONENT, 1, { 5 } },
		{ GL_RG, 2, { 0, 1 } },       { GL_DEPTH_STENCIL, 1, { 5 } },
	};

	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
		if (formats[i].token == token)
			return &formats[i];
	return NULL;
}

/* Packed types (table 3.8): bits of each component from the first one on, first in the highest bits unless reversed. */
struct packed {
	uint32_t token;
	unsigned bytes, n, bits[4], reversed;
};

static const struct packed *find_packed(uint32_t token)
{
	static const struct packed types[] = {
		{ GL_UNSIGNED_BYTE_3_3_2, 1, 3, { 3, 3, 2 }, 0 },
		{ GL_UNSIGNED_BYTE_2_3_3_REV, 1, 3, { 3, 3, 2 }, 1 },
		{ GL_UNSIGNED_SHORT_5_6_5, 2, 3, { 5, 6, 5 }, 0 },
		{ GL_UNSIGNED_SHORT_5_6_5_REV, 2, 3, { 5, 6, 5 }, 1 },
		{ GL_UNSIGNED_SHORT_4_4_4_4, 2, 4, { 4, 4, 4, 4 }, 0 },
		{ GL_UNSIGNED_SHORT_4_4_4_4_REV, 2, 4, { 4, 4, 4, 4 }, 1 },
		{ GL_UNSIGNED_SHORT_5_5_5_1, 2, 4, { 5, 5, 5, 1 }, 0 },
		{ GL_UNSIGNED_SHORT_1_5_5_5_REV, 2, 4, { 5, 5, 5, 1 }, 1 },
		{ GL_UNSIGNED_INT_8_8_8_8, 4, 4, { 8, 8, 8, 8 }, 0 },
		{ GL_UNSIGNED_INT_8_8_8_8_REV, 4, 4, { 8, 8, 8, 8 }, 1 },
		{ GL_UNSIGNED_INT_10_10_10_2, 4, 4, { 10, 10, 10, 2 }, 0 },
		{ GL_UNSIGNED_INT_2_10_10_10_REV, 4, 4, { 10, 10, 10, 2 }, 1 },
	};

	for (size_t i = 0; i < sizeof(types) / sizeof(types[0]); i++)
		if (types[i].token == token)
			return &types[i];
	return NULL;
}

static size_t plain_bytes(uint32_t type)
{
	switch (type) {
	case GL_UNSIGNED_BYTE:
	case GL_BYTE:
		return 1;
	case GL_UNSIGNED_SHORT:
	case GL_SHORT:
	case GL_HALF_FLOAT:
		return 2;
	case GL_UNSIGNED_INT:
	case GL_INT:
	case GL_FLOAT:
	case GL_UNSIGNED_INT_24_8:
		return 4;
	case GL_FLOAT_32_UNSIGNED_INT_24_8_REV:
		return 8;
	default:
		return 0;
	}
}

static uint32_t load(const uint8_t *p, size_t n, int swap)
{
	uint32_t value = 0;

	for (size_t i = 0; i < n; i++)
		value |= (uint32_t)p[swap ? n - 1 - i : i] << (8 * i);
	return value;
}

/* A number of 16 bits: sign, 5 bits of exponent, 10 of mantissa. */
static float half_float(uint32_t h)
{
	int exponent = (int)(h >> 10 & 31);
	float mantissa = (float)(h & 1023), f;

	if (exponent == 31)
		f = h & 1023 ? NAN : INFINITY;
	else
		f = exponent ? ldexpf(mantissa + 1024, exponent - 25) : ldexpf(mantissa, -24);
	return h >> 15 ? -f : f;
}

/* One component as a float (table 2.9); of depths packed with stencil values the depth. */
static float plain_component(const uint8_t *p, uint32_t type, int swap)
{
	size_t bytes = plain_bytes(type);
	uint32_t u = load(p, bytes < 4 ? bytes : 4, swap);
	float f;

	switch (type) {
	case GL_HALF_FLOAT:
		return half_float(u);
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
		return (float)((2.0 * (int32_t)u + 1) / 4294967295.0);
	default:
		memcpy(&f, &u, 4);
		return f;
	}
}

static void packed_components(const uint8_t *p, const struct packed *t, int swap, float out[4])
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

/* Sec. 3.6.5: scale and bias, then the colour maps. */
static void transfer(const struct gls_state *st, float rgba[4])
{
	const struct gls_pixel *p = &st->a.pixel;

	for (unsigned i = 0; i < 4; i++) {
		const struct gls_pixel_map *m = &st->pixel_maps[GL_PIXEL_MAP_R_TO_R - GL_PIXEL_MAP_I_TO_I + i];

		rgba[i] = rgba[i] * p->scale[i] + p->bias[i];
		if (p->map_color) {
			float v = rgba[i] > 0 ? rgba[i] < 1 ? rgba[i] : 1 : 0;
			rgba[i] = m->size ? m->values[(uint32_t)(v * (float)(m->size - 1) + 0.5f)] : 0;
		}
	}
}

void gls_unpack_stencil(const struct gls_state *st, uint32_t type, uint32_t width, uint32_t height, const uint8_t *data, size_t n,
                        uint8_t *out)
{
	const struct gls_pixel_store *u = &st->client.unpack;
	size_t group = plain_bytes(type), align = (size_t)u->alignment;
	size_t row = (group * (u->row_length > 0 ? (size_t)u->row_length : width) + align - 1) / align * align;

	for (uint32_t y = 0; y < height; y++)
		for (uint32_t i = 0; i < width; i++) {
			size_t at = ((size_t)u->skip_rows + y) * row + ((size_t)u->skip_pixels + i) * group;

			/* the lowest byte of the last word */
			*out++ = at <= n && group <= n - at ? data[at + group - (u->swap_bytes ? 1 : 4)] : 0;
		}
}

static int has_transfer(const struct gls_pixel *p)
{
	for (unsigned i = 0; i < 4; i++)
		if (p->scale[i] != 1 || p->bias[i] != 0)
			return 1;
	return p->map_color != 0;
}

void gls_store_pixel(const struct gls_state *st, uint32_t internal_format, float rgba[4], uint8_t *out)
{
	transfer(st, rgba);
	gls_format_store(gls_format_find(internal_format), rgba, out);
}

/*
 * Bytes and floats that nothing transfers end as bytes in other places: for each of a texel's four the member of the group that
 * it is, or one of these.
 */
enum { ZERO_BYTE = 4, FULL_BYTE };

static void places_of(const struct format *f, uint32_t base, uint8_t place[4])
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

/* Places as numbers of four bytes: a member times its number stands in all its places; `rest` are the other bytes. */
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

/* Colour indices as the colours that maps make of them (sec. 3.6.5). */
static int unpack_indices(struct gls_exec *x, struct gls_state *st, uint32_t type, uint32_t width, uint32_t height,
                          const uint8_t *data, size_t n, const struct gls_format *to, uint8_t *out)
{
	if (gls_unpack_indices(st, GL_COLOR_INDEX, type, data, n, width, height, out)) {
		gls_unsupported(x, "pixels of this format and type");
		return -1;
	}
	for (size_t i = (size_t)width * height; i-- > 0;) { /* from the last on: texels may be larger than colours */
		float v[4];

		gls_texel_load(4, out + 4 * i, v);
		gls_format_store(to, v, out + (to->numbers ? 16 : 4) * i);
	}
	return 0;
}

int gls_unpack_pixels(struct gls_exec *x, struct gls_state *st, uint32_t format, uint32_t type, uint32_t width,
                      uint32_t height, uint32_t depth, const uint8_t *data, size_t n, uint32_t internal_format,
                      uint8_t *out)
{
	const struct gls_pixel_store *u = &st->client.unpack;
	const struct format *f = find_format(format);
	const struct packed *packed = find_packed(type);
	const struct gls_format *to = gls_format_find(internal_format);
	size_t component = plain_bytes(type), group, row, image, start, step = to->numbers ? 16 : 4;
	int depth_texels = to->base == GL_DEPTH_COMPONENT, do_transfer = has_transfer(&st->a.pixel), cut = 0;
	uint8_t place[4];
	int plain;

	if (format == GL_COLOR_INDEX && !depth_texels)
		return unpack_indices(x, st, type, width, height * (depth ? depth : 1), data, n, to, out);
	if (!f || (!component && !packed) || depth_texels != (f->to[0] == 5) || (packed && packed->n != f->n) ||
	    (format == GL_DEPTH_STENCIL) != (type == GL_UNSIGNED_INT_24_8 || type == GL_FLOAT_32_UNSIGNED_INT_24_8_REV)) {
		gls_unsupported(x, "pixels of this format and type");
		return -1;
	}
	group = packed ? packed->bytes : f->n * component;
	row = group * (u->row_length > 0 ? (size_t)u->row_length : width);
	/* Rows begin at multiples of the alignment (sec. 3.6.4, equation 3.13). */
	row = (row + (size_t)u->alignment - 1) / (size_t)u->alignment * (size_t)u->alignment;
	image = row * (u->image_height > 0 ? (size_t)u->image_height : height);
	start = (depth ? (size_t)u->skip_images * image : 0) + (size_t)u->skip_rows * row + (size_t)u->skip_pixels * group;
	plain = (type == GL_UNSIGNED_BYTE || (type == GL_FLOAT && !u->swap_bytes)) && !do_transfer && !depth_texels &&
	        !to->bits[0] && !to->bits[3] && !to->s3tc && !to->numbers;
	if (plain)
		places_of(f, to->base, place);
	for (uint32_t z = 0; z < (depth ? depth : 1); z++)
		for (uint32_t y = 0; y < height; y++) {
			size_t at = start + z * image + y * row;
			if (plain && at <= n && group * width <= n - at) {
				(type == GL_FLOAT ? unpack_floats : unpack_bytes)(data + at, f->n, width, place, out);
				out += 4 * (size_t)width;
				continue;
			}
			for (uint32_t i = 0; i < width; i++, at += group, out += step) {
				float rgba[4] = { 0, 0, 0, 1 }, v[4];
				if (at > n || group > n - at) {
					cut = 1;
					memset(out, 0, step);
					continue;
				}
				if (packed)
					packed_components(data + at, packed, u->swap_bytes, v);
				else
					for (unsigned k = 0; k < f->n; k++)
						v[k] = plain_component(data + at + k * component, type, u->swap_bytes);
				if (depth_texels) {
					v[0] = v[0] * st->a.pixel.depth_scale + st->a.pixel.depth_bias;
					v[0] = v[0] > 0 ? v[0] < 1 ? v[0] : 1 : 0;
					memcpy(out, v, 4);
					continue;
				}
				for (unsigned k = 0; k < f->n; k++) {
					if (f->to[k] == 4)
						rgba[0] = rgba[1] = rgba[2] = v[k];
					else
						rgba[f->to[k]] = v[k];
				}
				if (do_transfer)
					transfer(st, rgba);
				gls_format_store(to, rgba, out);
			}
		}
	return cut ? -2 : 0;
}

static void pixel_store(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	int64_t value = arg_i(c, 1);
	uint32_t pname = arg_u(c, 0);
	struct gls_pixel_store *s = pname >= GL_PACK_SWAP_BYTES && pname <= GL_PACK_ALIGNMENT ? &st->client.pack
	                                                                                     : &st->client.unpack;

	if (value < 0 || value > (1 << 24)) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	switch (pname) {
	case GL_PACK_SWAP_BYTES:
	case GL_UNPACK_SWAP_BYTES:
		s->swap_bytes = value != 0;
		break;
	case GL_PACK_LSB_FIRST:
	case GL_UNPACK_LSB_FIRST:
		s->lsb_first = value != 0;
		break;
	case GL_PACK_ROW_LENGTH:
	case GL_UNPACK_ROW_LENGTH:
		s->row_length = (int32_t)value;
		break;
	case GL_PACK_SKIP_ROWS:
	case GL_UNPACK_SKIP_ROWS:
		s->skip_rows = (int32_t)value;
		break;
	case GL_PACK_SKIP_PIXELS:
	case GL_UNPACK_SKIP_PIXELS:
		s->skip_pixels = (int32_t)value;
		break;
	case GL_PACK_ALIGNMENT:
	case GL_UNPACK_ALIGNMENT:
		if (value != 1 && value != 2 && value != 4 && value != 8)
			gls_error(x, st, GL_INVALID_VALUE);
		else
			s->alignment = (int32_t)value;
		break;
	case GL_UNPACK_IMAGE_HEIGHT:
		st->client.unpack.image_height = (int32_t)value;
		break;
	case GL_UNPACK_SKIP_IMAGES:
		st->client.unpack.skip_images = (int32_t)value;
		break;
	case GL_PACK_IMAGE_HEIGHT:
		st->client.pack.image_height = (int32_t)value;
		break;
	case GL_PACK_SKIP_IMAGES:
		st->client.pack.skip_images = (int32_t)value;
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

GLS_HANDLER(glPixelStorei, CLIENT) { pixel_store(x, st, c); }
GLS_HANDLER(glPixelStoref, CLIENT) { pixel_store(x, st, c); }

/* ---- specifying images ---- */

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

/*
 * Generated mipmaps (sec. 3.8.8 leaves the filter open). Mesa draws each level from the one below with linear filtering: a texel
 * is what lies at its centre, between two neighbours in each direction, in places of 1/256 texel, rounded after each step.
 */
struct tap {
	uint32_t first, second;
	float weight; /* of the second, [0,1) */
};

/* exact: as floats are filtered; else in 1/256 texel */
static struct tap tap_at(uint32_t i, uint32_t size, uint32_t from, int exact)
{
	double place = (i + 0.5) / size * from;
	double at = fmax((exact ? place : rint(place * 256) / 256) - 0.5, 0);
	struct tap t = { (uint32_t)at, 0, (float)(at - floor(at)) };

	t.second = t.first + 1 < from ? t.first + 1 : from - 1;
	return t;
}

static float mix(float a, float b, float weight)
{
	return a + (b - a) * weight;
}

/* Texels as numbers: bytes of a colour (in linear light where they are encoded), its floats, or one depth. */
static void load_texel(const uint8_t *texel, int floats, const float *linear, float out[4])
{
	memcpy(out, texel, 4 * (size_t)floats);
	for (unsigned k = 0; k < 4 && !floats; k++)
		out[k] = linear && k < 3 ? linear[texel[k]] : (float)texel[k];
}

static void mix_texels(float a[4], const float b[4], float weight, int round)
{
	for (unsigned k = 0; k < 4; k++)
		a[k] = round ? floorf(mix(a[k], b[k], weight) + 0.5f) : mix(a[k], b[k], weight);
}

/* floats: how many a texel is, 0: it is bytes */
static void filter_texel(const struct gls_level *from, int floats, const float *linear, const struct tap t[3], float out[4])
{
	int round = !floats && !linear;

	for (unsigned z = 0; z < (from->depth > 1 ? 2u : 1u); z++) {
		float slice[4] = { 0 };

		for (unsigned y = 0; y < (from->height > 1 ? 2u : 1u); y++) {
			const uint8_t *row = from->texels + from->texel_bytes * ((size_t)(z ? t[2].second : t[2].first) * from->height +
			                                         (y ? t[1].second : t[1].first)) * from->width;
			float left[4] = { 0 }, right[4] = { 0 };

			load_texel(row + from->texel_bytes * (size_t)t[0].first, floats, linear, left);
			load_texel(row + from->texel_bytes * (size_t)t[0].second, floats, linear, right);
			mix_texels(left, right, t[0].weight, round);
			if (y)
				mix_texels(slice, left, t[1].weight, round);
			else
				memcpy(slice, left, sizeof(slice));
		}
		if (z)
			mix_texels(out, slice, t[2].weight, round);
		else
			memcpy(out, slice, sizeof(slice));
	}
}

/* The mean of each of four bytes, rounded up (Dietz, "The Aggregate Magic Algorithms": average of integers). */
static uint32_t mean_bytes(uint32_t a, uint32_t b)
{
	return (a | b) - (((a ^ b) >> 1) & 0x7f7f7f7fu);
}

/* The same of a plane that is halved both ways, by bytes. */
static void halve(const struct gls_level *from, uint32_t w, uint32_t h, uint8_t *out)
{
	for (uint32_t y = 0; y < h; y++) {
		const uint8_t *low = from->texels + 8 * (size_t)y * from->width, *high = low + 4 * (size_t)from->width;

		for (uint32_t x = 0; x < w; x++, low += 8, high += 8, out += 4) {
			uint32_t below[2], above[2], mean;

			memcpy(below, low, 8);
			memcpy(above, high, 8);
			mean = mean_bytes(mean_bytes(below[0], below[1]), mean_bytes(above[0], above[1]));
			memcpy(out, &mean, 4);
		}
	}
}

/*
 * What Mesa cannot draw to it averages as it is stored, two by two texels, of which the last are left out where their number is odd;
 * integers are rounded down.
 */
static int is_averaged(const struct gls_format *f)
{
	return (f->srgb && f->base != GL_RGB && f->base != GL_RGBA) || f->numbers == GLS_9E5 || f->block_bytes || f->s3tc;
}

static void average_level(const struct gls_level *from, struct gls_level *to, const struct gls_format *format)
{
	const uint32_t n[3] = { from->width > to->width ? 2 : 1, from->height > to->height ? 2 : 1, from->depth > to->depth ? 2 : 1 };
	const uint32_t count = n[0] * n[1] * n[2];

	for (size_t i = 0; i < gls_level_count(to); i++) {
		const size_t x = i % to->width * n[0], y = i / to->width % to->height * n[1], z = i / to->width / to->height * n[2];
		float sum[4] = { 0 }, v[4];

		for (uint32_t k = 0; k < count; k++) {
			size_t at = ((z + k / n[0] / n[1]) * from->height + y + k / n[0] % n[1]) * from->width + x + k % n[0];

			gls_texel_load(from->texel_bytes, from->texels + from->texel_bytes * at, v);
			for (unsigned c = 0; c < 4; c++)
				sum[c] += v[c];
		}
		for (unsigned c = 0; c < 4; c++) {
			v[c] = sum[c] / (float)count;
			if (!format->numbers)
				v[c] = floorf(v[c] * 255 + 0.0625f) / 255; /* of eight texels the parts are eighths */
		}
		gls_format_store(format, v, to->texels + to->texel_bytes * i);
	}
}

/* linear: what bytes of encoded colours are in linear light, else NULL */
static void generate_level(const struct gls_level *from, struct gls_level *to, const struct gls_format *format, const float *linear)
{
	int floats = to->base_format == GL_DEPTH_COMPONENT ? 1 : format->numbers ? 4 : 0;

	if (is_averaged(format)) {
		average_level(from, to, format);
		return;
	}
	if (!floats && !linear && !format->bits[0] && !format->bits[3] && from->width == 2 * to->width &&
	    from->height == 2 * to->height && from->depth == 1) {
		halve(from, to->width, to->height, to->texels);
		return;
	}
	for (size_t i = 0; i < gls_level_count(to); i++) {
		struct tap t[3] = { tap_at((uint32_t)(i % to->width), to->width, from->width, floats || linear),
			            tap_at((uint32_t)(i / to->width % to->height), to->height, from->height, floats || linear),
			            tap_at((uint32_t)(i / to->width / to->height), to->depth, from->depth, floats || linear) };
		float v[4] = { 0 };

		filter_texel(from, floats, linear, t, v);
		for (unsigned k = 0; k < 4 && !floats; k++)
			v[k] = linear && k < 3 ? gls_srgb_from_linear(v[k] / 255) : v[k] / 255;
		if (floats == 1)
			memcpy(to->texels + 4 * i, v, 4);
		else
			gls_format_draw(format, v, to->texels + to->texel_bytes * i);
	}
}

void gls_texture_generate_mipmaps(struct gls_exec *x, struct gls_texture *t, unsigned face)
{
	struct gls_level *from = t->parameters.base_level < GLS_MAX_LEVELS ? &t->levels[face][t->parameters.base_level] : NULL;
	const struct gls_format *format = from && from->texels ? gls_format_find(from->internal_format) : NULL;
	float linear[256];

	for (unsigned i = 0; format && format->srgb && i < 256; i++)
		linear[i] = gls_linear_from_srgb((float)i / 255) * 255;
	for (uint32_t l = t->parameters.base_level + 1; format && l < GLS_MAX_LEVELS && l <= t->parameters.max_level; l++) {
		struct gls_level *to = &t->levels[face][l];
		uint32_t w = from->width > 1 ? from->width / 2 : 1, h = from->height > 1 ? from->height / 2 : 1;
		uint32_t d = from->depth > 1 ? from->depth / 2 : 1;
		uint8_t *texels;

		if (from->width == 1 && from->height == 1 && from->depth == 1)
			break;
		if (from->border) {
			gls_unsupported(x, "generated mipmaps of textures with borders");
			break;
		}
		texels = malloc((size_t)w * h * d * from->texel_bytes);
		if (!texels) {
			gls_out_of_memory(x, (size_t)w * h * d * from->texel_bytes);
			return;
		}
		free(to->texels);
		*to = *from;
		to->width = w;
		to->height = h;
		to->depth = d;
		to->texels = texels;
		to->bytes = (size_t)w * h * d * to->texel_bytes;
		generate_level(from, to, format, format->srgb ? linear : NULL);
		from = to;
	}
}

struct gls_texture *gls_texture_find_level(struct gls_exec *x, struct gls_state *st, uint32_t token, int64_t level,
                                           unsigned *face)
{
	int target = gls_texture_target_of(token, face);
	struct gls_texture *t;

	if (token == GL_PROXY_TEXTURE_1D || token == GL_PROXY_TEXTURE_2D || token == GL_PROXY_TEXTURE_3D ||
	    token == GL_PROXY_TEXTURE_CUBE_MAP || token == GL_PROXY_TEXTURE_RECTANGLE)
		return NULL;
	if (target < 0) {
		gls_error(x, st, GL_INVALID_ENUM);
		return NULL;
	}
	if (level < 0 || level >= GLS_MAX_LEVELS) {
		gls_error(x, st, GL_INVALID_VALUE);
		return NULL;
	}
	t = gls_texture_bound(x, st, st->a.texturing.active, (unsigned)target);
	gls_texture_settle(x, st, t);
	return t;
}

/* Textures of one dimension are not compressed. */
static uint32_t uncompressed(uint32_t internal_format)
{
	switch (internal_format) {
	case GL_COMPRESSED_RGB:
		return GL_RGB;
	case GL_COMPRESSED_RGBA:
		return GL_RGBA;
	case GL_COMPRESSED_SRGB:
		return GL_SRGB;
	case GL_COMPRESSED_SRGB_ALPHA:
		return GL_SRGB_ALPHA;
	default:
		return internal_format;
	}
}

struct gls_level *gls_texture_specify(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, unsigned face,
                                      int64_t level, uint32_t internal_format, int64_t width, int64_t height, int64_t depth,
                                      int64_t border)
{
	struct gls_level *l = &t->levels[face][level];
	uint32_t base = gls_base_format(internal_format);
	int64_t least = border == 1 ? 2 : 0;
	size_t bytes;

	if (t->target == GLS_TEXTURE_1D)
		internal_format = uncompressed(internal_format);
	if (!base) {
		/* Mesa takes more formats than GL 2.1 has; those of other kinds hold no colours for fixed function. */
		gls_unsupported(x, "textures of this internal format");
		return NULL;
	}
	if (width < least || height < (t->target == GLS_TEXTURE_1D ? 0 : least) || depth < (t->target == GLS_TEXTURE_3D ? least : 0) ||
	    width > MAX_SIZE + 2 || height > MAX_SIZE + 2 || depth > MAX_SIZE + 2 || (border != 0 && border != 1)) {
		gls_error(x, st, GL_INVALID_VALUE);
		return NULL;
	}
	if (width * height * depth * gls_texel_bytes(internal_format) >= MAX_BYTES) {
		gls_error(x, st, GL_OUT_OF_MEMORY);
		return NULL;
	}
	bytes = (size_t)(width * height * depth) * (gls_texel_bytes(internal_format) + (gls_format_stencil_bits(internal_format) ? 1 : 0));
	free(l->texels);
	*l = (struct gls_level){ (uint32_t)width, (uint32_t)height, (uint32_t)depth, (uint32_t)border, internal_format, base,
	                         NULL, bytes, 0, gls_texel_bytes(internal_format), { 0 } };
	gls_texture_changed(t);
	if (!bytes)
		return NULL;
	l->texels = calloc(1, bytes);
	if (!l->texels)
		gls_out_of_memory(x, bytes);
	return l->texels ? l : NULL;
}

static void tex_image(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n_dims)
{
	unsigned face;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	unsigned border = 3 + n_dims; /* argument's number; format, type and pixels follow */
	struct gls_level *l;
	size_t n;
	const uint8_t *pixels;

	if (!t)
		return;
	l = gls_texture_specify(x, st, t, face, arg_i(c, 1), arg_u(c, 2), arg_i(c, 3), n_dims > 1 ? arg_i(c, 4) : 1,
	            n_dims > 2 ? arg_i(c, 5) : 1, arg_i(c, border));
	if (!l)
		return;
	pixels = gls_pixel_source(st, c, border + 3, &n);
	if (pixels && gls_unpack_pixels(x, st, arg_u(c, border + 1), arg_u(c, border + 2), l->width, l->height, n_dims > 2 ? l->depth : 0, pixels,
	                                n, l->internal_format, l->texels) == -2)
		gls_unsupported(x, "pixels beyond what the recording holds");
	if (pixels && gls_level_stencil(l) && arg_u(c, border + 1) == GL_DEPTH_STENCIL)
		gls_unpack_stencil(st, arg_u(c, border + 2), l->width, l->height * l->depth, pixels, n, gls_level_stencil(l));
	if (t->parameters.generate_mipmap && arg_i(c, 1) == (int64_t)t->parameters.base_level)
		gls_texture_generate_mipmaps(x, t, face);
}

/* Copy texels to a place in a level. */
static void place(struct gls_level *l, const int64_t at[3], const int64_t size[3], const uint8_t *texels)
{
	for (int64_t z = 0; z < size[2]; z++)
		for (int64_t y = 0; y < size[1]; y++)
			memcpy(l->texels + l->texel_bytes * (((at[2] + z) * l->height + at[1] + y) * l->width + at[0]),
			       texels + l->texel_bytes * (z * size[1] + y) * size[0], l->texel_bytes * (size_t)size[0]);
}

static void tex_sub_image(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n_dims)
{
	unsigned face, size = 2 + n_dims, format = 2 + 2 * n_dims;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	struct gls_level *l = t ? &t->levels[face][arg_i(c, 1)] : NULL;
	int64_t at[3] = { 0 }, extent[3] = { 1, 1, 1 }, room[3];
	size_t n;
	const uint8_t *pixels;
	uint8_t *texels;

	if (!l)
		return;
	if (!l->texels) {
		gls_error(x, st, GL_INVALID_OPERATION);
		return;
	}
	room[0] = l->width;
	room[1] = l->height;
	room[2] = l->depth;
	for (unsigned i = 0; i < n_dims; i++) {
		at[i] = arg_i32(c, 2 + i) + l->border;
		extent[i] = arg_i32(c, size + i);
		if (at[i] < 0 || extent[i] < 0 || at[i] > room[i] || extent[i] > room[i] - at[i]) {
			gls_error(x, st, GL_INVALID_VALUE);
			return;
		}
	}
	pixels = gls_pixel_source(st, c, format + 2, &n);
	if (!pixels || !extent[0] || !extent[1] || !extent[2])
		return;
	texels = gls_scratch(x, (size_t)(extent[0] * extent[1] * extent[2]) * l->texel_bytes);
	if (!texels || gls_unpack_pixels(x, st, arg_u(c, format), arg_u(c, format + 1), (uint32_t)extent[0],
	                                 (uint32_t)extent[1], n_dims > 2 ? (uint32_t)extent[2] : 0, pixels, n, l->internal_format,
	                                 texels) == -1)
		return;
	place(l, at, extent, texels);
	if (gls_level_stencil(l) && arg_u(c, format) == GL_DEPTH_STENCIL) {
		gls_unpack_stencil(st, arg_u(c, format + 1), (uint32_t)extent[0], (uint32_t)(extent[1] * extent[2]), pixels, n, texels);
		for (int64_t y = 0; y < extent[1] * extent[2]; y++)
			memcpy(gls_level_stencil(l) + ((at[2] + y / extent[1]) * room[1] + at[1] + y % extent[1]) * room[0] + at[0],
			       texels + y * extent[0], (size_t)extent[0]);
	}
	gls_texture_changed(t);
	if (t->parameters.generate_mipmap && arg_i(c, 1) == (int64_t)t->parameters.base_level)
		gls_texture_generate_mipmaps(x, t, face);
}

/* ---- compressed images, sec. 3.8.3 ---- */

/* Texels of an image of blocks, slices one after the other. @return 0, or -1 (counted) */
static int unpack_compressed(struct gls_exec *x, uint32_t internal_format, const int64_t size[3], const uint8_t *data, size_t n,
                             uint8_t *texels)
{
	for (int64_t z = 0; z < size[2]; z++)
		if (gls_decompress(internal_format, (uint32_t)size[0], (uint32_t)size[1], data + (size_t)z * (n / (size_t)size[2]),
		                   n / (size_t)size[2], texels + gls_texel_bytes(internal_format) * (size_t)(z * size[0] * size[1]))) {
			gls_unsupported(x, "compressed images of this format");
			return -1;
		}
	return 0;
}

static void compressed_image(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n_dims)
{
	unsigned face;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	struct gls_level *l;
	size_t n;
	const uint8_t *pixels = gls_pixel_source(st, c, n_dims + 5, &n);

	if (!t)
		return;
	l = gls_texture_specify(x, st, t, face, arg_i(c, 1), arg_u(c, 2), arg_i(c, 3), n_dims > 1 ? arg_i(c, 4) : 1,
	                        n_dims > 2 ? arg_i(c, 5) : 1, arg_i(c, n_dims + 3));
	if (l && pixels)
		unpack_compressed(x, l->internal_format, (int64_t[3]){ l->width, l->height, l->depth }, pixels, n, l->texels);
	if (l && t->parameters.generate_mipmap && arg_i(c, 1) == (int64_t)t->parameters.base_level)
		gls_texture_generate_mipmaps(x, t, face);
}

static void compressed_sub_image(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n_dims)
{
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
	if (!l->texels || l->internal_format != arg_u(c, 2 + 2 * n_dims)) {
		gls_error(x, st, GL_INVALID_OPERATION);
		return;
	}
	for (unsigned i = 0; i < 3; i++)
		if (at[i] < 0 || size[i] < 0 || at[i] + size[i] > (i == 0 ? l->width : i == 1 ? l->height : l->depth)) {
			gls_error(x, st, GL_INVALID_VALUE);
			return;
		}
	if (!size[0] || !size[1] || !size[2])
		return;
	texels = gls_scratch(x, (size_t)(size[0] * size[1] * size[2]) * l->texel_bytes);
	if (texels && !unpack_compressed(x, l->internal_format, size, pixels, n, texels))
		place(l, at, size, texels);
	gls_texture_changed(t);
	if (t->parameters.generate_mipmap && arg_i(c, 1) == (int64_t)t->parameters.base_level)
		gls_texture_generate_mipmaps(x, t, face);
}

GLS_HANDLER(glCompressedTexImage1D, STATE) { compressed_image(x, st, c, 1); }
GLS_HANDLER(glCompressedTexImage2D, STATE) { compressed_image(x, st, c, 2); }
GLS_HANDLER(glCompressedTexImage3D, STATE) { compressed_image(x, st, c, 3); }
GLS_HANDLER(glCompressedTexSubImage1D, STATE) { compressed_sub_image(x, st, c, 1); }
GLS_HANDLER(glCompressedTexSubImage2D, STATE) { compressed_sub_image(x, st, c, 2); }
GLS_HANDLER(glCompressedTexSubImage3D, STATE) { compressed_sub_image(x, st, c, 3); }

GLS_HANDLER(glTexImage1D, STATE) { tex_image(x, st, c, 1); }
GLS_HANDLER(glTexImage2D, STATE) { tex_image(x, st, c, 2); }
GLS_HANDLER(glTexImage3D, STATE) { tex_image(x, st, c, 3); }
GLS_HANDLER(glTexSubImage1D, STATE) { tex_sub_image(x, st, c, 1); }
GLS_HANDLER(glTexSubImage2D, STATE) { tex_sub_image(x, st, c, 2); }
GLS_HANDLER(glTexSubImage3D, STATE) { tex_sub_image(x, st, c, 3); }

/* ARB_texture_storage: all levels at once, without texels. */
static void tex_storage(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n_dims)
{
	int64_t size[3] = { arg_i(c, 3), n_dims > 1 ? arg_i(c, 4) : 1, n_dims > 2 ? arg_i(c, 5) : 1 };
	unsigned face, n_faces = arg_u(c, 0) == GL_TEXTURE_CUBE_MAP ? 6 : 1;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), 0, &face);

	for (int64_t level = 0; t && level < arg_i(c, 1) && level < GLS_MAX_LEVELS; level++)
		for (face = 0; face < n_faces; face++)
			gls_texture_specify(x, st, t, face, level, arg_u(c, 2), size[0] >> level ? size[0] >> level : 1,
			                    size[1] >> level ? size[1] >> level : 1, n_dims > 2 && size[2] >> level ? size[2] >> level : 1, 0);
}

GLS_HANDLER(glTexStorage1D, STATE) { tex_storage(x, st, c, 1); }
GLS_HANDLER(glTexStorage2D, STATE) { tex_storage(x, st, c, 2); }
GLS_HANDLER(glTexStorage3D, STATE) { tex_storage(x, st, c, 3); }

/* ARB_clear_texture: one pixel, as TexImage would take it, all over a level. */
GLS_HANDLER(glClearTexImage, NOW)
{
	struct gls_texture *t = table_find(&st->share->textures, arg_u(c, 0));
	const struct gls_pixel_store unpack = st->client.unpack;
	size_t n;
	const uint8_t *pixel = arg_blob(c, 4, &n);
	uint8_t texel[16] = { 0 };

	gls_flush(x);
	st->dirty |= GLS_DIRTY_MATERIAL;
	if (!t || arg_i(c, 1) < 0 || arg_i(c, 1) >= GLS_MAX_LEVELS) {
		gls_error(x, st, GL_INVALID_OPERATION);
		return;
	}
	gls_texture_settle(x, st, t);
	for (unsigned face = 0; face < 6; face++) {
		struct gls_level *l = &t->levels[face][arg_i(c, 1)];

		if (!l->texels)
			continue;
		st->client.unpack = (struct gls_pixel_store){ .alignment = 1, .swap_bytes = unpack.swap_bytes };
		if (pixel)
			gls_unpack_pixels(x, st, arg_u(c, 2), arg_u(c, 3), 1, 1, 0, pixel, n, l->internal_format, texel);
		st->client.unpack = unpack;
		for (size_t i = 0; i < gls_level_count(l); i++)
			memcpy(l->texels + l->texel_bytes * i, texel, l->texel_bytes);
		gls_texture_changed(t);
	}
}

/* Of a texture's level the image that place z lies in, and which slice of it that is. NULL: there is none. */
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

/* ARB_copy_image, NV_copy_image: texels from one level to another as they are, slice by slice. */
static void copy_image(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	struct gls_texture *from = table_find(&st->share->textures, arg_u(c, 0)), *to = table_find(&st->share->textures, arg_u(c, 6));
	int64_t width = arg_i(c, 12), height = arg_i(c, 13);

	gls_flush(x);
	st->dirty |= GLS_DIRTY_MATERIAL;
	if (arg_u(c, 1) == GL_RENDERBUFFER || arg_u(c, 7) == GL_RENDERBUFFER) {
		gls_unsupported(x, "copies of renderbuffers");
		return;
	}
	gls_texture_settle(x, st, from);
	gls_texture_settle(x, st, to);
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
		b->missing = b->missing ? b->missing : a->missing;
		gls_texture_changed(to);
	}
}

GLS_HANDLER(glCopyImageSubData, NOW) { copy_image(x, st, c); }
GLS_HANDLER(glCopyImageSubDataNV, NOW) { copy_image(x, st, c); }

GLS_HANDLER(glGenerateMipmap, STATE)
{
	unsigned face;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), 0, &face);

	if (!t)
		return;
	for (face = 0; face < (t->target == GLS_TEXTURE_CUBE ? 6u : 1u); face++)
		gls_texture_generate_mipmaps(x, t, face);
	gls_texture_changed(t);
}

/* ---- pixel transfer, sec. 3.6.3 ---- */

static void set_transfer(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	struct gls_pixel *p = &st->a.pixel;
	float value = arg_f(c, 1);

	switch (arg_u(c, 0)) {
	case GL_RED_SCALE:
		p->scale[0] = value;
		break;
	case GL_GREEN_SCALE:
		p->scale[1] = value;
		break;
	case GL_BLUE_SCALE:
		p->scale[2] = value;
		break;
	case GL_ALPHA_SCALE:
		p->scale[3] = value;
		break;
	case GL_RED_BIAS:
		p->bias[0] = value;
		break;
	case GL_GREEN_BIAS:
		p->bias[1] = value;
		break;
	case GL_BLUE_BIAS:
		p->bias[2] = value;
		break;
	case GL_ALPHA_BIAS:
		p->bias[3] = value;
		break;
	case GL_DEPTH_SCALE:
		p->depth_scale = value;
		break;
	case GL_DEPTH_BIAS:
		p->depth_bias = value;
		break;
	case GL_MAP_COLOR:
		p->map_color = value != 0;
		break;
	case GL_MAP_STENCIL:
		p->map_stencil = value != 0;
		break;
	case GL_INDEX_SHIFT:
		p->index_shift = (int32_t)arg_i(c, 1);
		break;
	case GL_INDEX_OFFSET:
		p->index_offset = (int32_t)arg_i(c, 1);
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

GLS_HANDLER(glPixelTransferf, STATE) { set_transfer(x, st, c); }
GLS_HANDLER(glPixelTransferi, STATE) { set_transfer(x, st, c); }
GLS_HANDLER(glPixelZoom, STATE)
{
	st->a.pixel.zoom[0] = arg_f(c, 0);
	st->a.pixel.zoom[1] = arg_f(c, 1);
}
