/*
 * Generated mipmaps (sec. 3.8.8 does not specify the filter). Mesa draws each level from the one below it with linear
 * filtering: a texel's centre lies between two texels in each direction. Weights are multiples of 1/256; results are
 * rounded after each direction.
 */
#include "replay/gl/texture/mipmap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/texture/level.h"
#include "replay/gl/texture/texcompress.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "scene/mesa.h"

struct tap {
	uint32_t first, second;
	float weight; /* the second one's, [0,1) */
};

/* exact: as floats are filtered; otherwise in 1/256 texel */
static struct tap tap_at(uint32_t i, uint32_t size, uint32_t from, int exact)
{
	double place = (i + 0.5) / size * from;
	double at = fmax((exact ? place : rint(place * 256) / 256) - 0.5, 0);
	struct tap t = { (uint32_t)at, 0, (float)(at - floor(at)) };

	t.second = t.first + 1 < from ? t.first + 1 : from - 1;
	return t;
}

/*
 * As tap_at, for a square that llvmpipe draws with floats, exact to the last bit, because a mean may fall on a step of
 * the format. The coordinate is a plane over one of two triangles, computed from the vertex that triangle setup starts
 * with. other: the level's size in the other direction; far: 1: the coordinate is 1 at that vertex, 0: it is 0
 */
static struct tap tap_drawn(uint32_t i, uint32_t size, uint32_t other, uint32_t from, int far)
{
	const float along = (float)other * (1.0f / ((float)size * (float)other));
	const float origin = far ? 1.0f - along * ((float)size - 0.5f) : along * 0.5f;
	const float at = fmaxf(fmaf(along, (float)i, origin) * (float)from - 0.5f, 0);
	struct tap t = { (uint32_t)at, 0, at - floorf(at) };

	t.second = t.first + 1 < from ? t.first + 1 : from - 1;
	return t;
}

/* Texels as numbers: bytes of a colour (in linear light if they are encoded), its floats, or one depth. */
static void load_texel(const uint8_t *texel, int floats, const float *linear, float out[4])
{
	memcpy(out, texel, 4 * (size_t)floats);
	for (unsigned k = 0; k < 4 && !floats; k++)
		out[k] = linear && k < 3 ? linear[texel[k]] : (float)texel[k];
}

static void mix_texels(float a[4], const float b[4], float weight, int round)
{
	for (unsigned k = 0; k < 4; k++)
		a[k] = round ? floorf(a[k] + (b[k] - a[k]) * weight + 0.5f) : fmaf(weight, b[k] - a[k], a[k]);
}

/* floats: number of floats per texel, 0: bytes */
static void filter_texel(const struct gls_level *from, int floats, const float *linear, const struct tap t[3],
                         float out[4])
{
	int round = !floats && !linear;

	for (unsigned z = 0; z < (t[2].weight > 0 ? 2u : 1u); z++) {
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

/* Halve a plane in both directions, by bytes. */
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
 * Formats that Mesa cannot render to are averaged as stored, two by two texels. If the size is odd, the last texel is
 * ignored; integers are rounded down. In 25.0 encoded colours are averaged in linear light, as floats.
 */
static int is_averaged(const struct gls_format *f)
{
	return (f->srgb && f->base != GL_RGB && f->base != GL_RGBA) || f->numbers == GLS_9E5 || f->block_bytes || f->s3tc;
}

static void average_level(const struct gls_level *from, struct gls_level *to, const struct gls_format *format,
                          const float *linear)
{
	const uint32_t n[3] = { from->width > to->width ? 2 : 1, from->height > to->height ? 2 : 1,
		                from->depth > to->depth ? 2 : 1 };
	const uint32_t count = n[0] * n[1] * n[2];

	for (size_t i = 0; i < gls_level_count(to); i++) {
		const size_t x = i % to->width * n[0], y = i / to->width % to->height * n[1], z = i / to->width / to->height * n[2];
		float sum[4] = { 0 }, v[4];

		for (uint32_t k = 0; k < count; k++) {
			size_t at = ((z + k / n[0] / n[1]) * from->height + y + k / n[0] % n[1]) * from->width + x + k % n[0];

			gls_texel_load(from->texel_bytes, from->texels + from->texel_bytes * at, v);
			for (unsigned c = 0; c < 4; c++)
				sum[c] += linear && c < 3 ? linear[(unsigned)(v[c] * 255 + 0.5f)] / 255 : v[c];
		}
		for (unsigned c = 0; c < 4; c++) {
			v[c] = sum[c] / (float)count;
			if (linear && c < 3)
				v[c] = gls_srgb_from_linear(v[c]);
			else if (!format->numbers && !linear)
				v[c] = floorf(v[c] * 255 + 0.0625f) / 255; /* the mean of eight texels has steps of an eighth */
		}
		gls_format_store(format, v, 0, to->texels + to->texel_bytes * i);
	}
}

/*
 * The texels that a texel is the mean of, along each axis. The square's triangles meet along the diagonal from its
 * first texel.
 */
static void find_taps(const struct gls_level *from, const struct gls_level *to, int exact, uint32_t x, uint32_t y,
                      uint32_t z, struct tap t[3])
{
	const int above = (2 * (uint64_t)x + 1) * to->height < (2 * (uint64_t)y + 1) * to->width;

	t[0] = exact ? tap_drawn(x, to->width, to->height, from->width, 1) : tap_at(x, to->width, from->width, 0);
	t[1] = exact ? tap_drawn(y, to->height, to->width, from->height, above) : tap_at(y, to->height, from->height, 0);
	t[2] = tap_at(z, to->depth, from->depth, exact);
}

/* linear: linear values for bytes of encoded colours, else NULL. has_linear_means: as SCENE_MESA_LINEAR_MEANS */
static void generate_level(const struct gls_level *from, struct gls_level *to, const struct gls_format *format,
                           const float *linear, int has_linear_means)
{
	int floats = to->base_format == GL_DEPTH_COMPONENT ? 1 : format->numbers ? 4 : 0;

	if (is_averaged(format)) {
		average_level(from, to, format,
		              has_linear_means && !format->block_bytes && !format->s3tc ? linear : NULL);
		return;
	}
	if (!floats && !linear && !format->bits[0] && !format->bits[3] && from->width == 2 * to->width &&
	    from->height == 2 * to->height && from->depth == to->depth) {
		/* rows of layers follow each other */
		halve(from, to->width, to->height * to->depth, to->texels);
		return;
	}
	for (size_t i = 0; i < gls_level_count(to); i++) {
		const uint32_t x = (uint32_t)(i % to->width), y = (uint32_t)(i / to->width % to->height);
		const uint32_t z = (uint32_t)(i / to->width / to->height);
		struct tap t[3];
		float v[4] = { 0 };

		find_taps(from, to, floats || linear, x, y, z, t);
		filter_texel(from, floats, linear, t, v);
		for (unsigned k = 0; k < 4 && !floats; k++)
			v[k] = linear && k < 3 ? gls_srgb_from_linear(v[k] / 255) : v[k] / 255;
		if (floats == 1)
			memcpy(to->texels + 4 * i, v, 4);
		else
			gls_format_draw(format, v, to->texels + to->texel_bytes * i);
	}
}

static void recompress(struct gls_level *l, uint32_t z, const struct gls_format *format)
{
	gls_recompress(format, l->width, l->height, l->width, l->texels + l->texel_bytes * (size_t)z * l->width * l->height);
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
		uint32_t d = t->target != GLS_TEXTURE_3D || from->depth == 1 ? from->depth : from->depth / 2;
		uint8_t *texels;

		if (from->width == 1 && from->height == 1 && (from->depth == 1 || t->target != GLS_TEXTURE_3D))
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
		generate_level(from, to, format, format->srgb ? linear : NULL,
		               (x->st->mesa & SCENE_MESA_LINEAR_MEANS) != 0);
		from = to;
	}
	/* Compress last: each level is computed from uncompressed texels. */
	for (uint32_t l = t->parameters.base_level + 1; format && format->s3tc && from >= &t->levels[face][l]; l++)
		for (uint32_t z = 0; z < t->levels[face][l].depth; z++)
			recompress(&t->levels[face][l], z, format);
}

void gls_texture_level_changed(struct gls_exec *x, struct gls_texture *t, unsigned face, int64_t level)
{
	if (t->parameters.generate_mipmap && level == (int64_t)t->parameters.base_level)
		gls_texture_generate_mipmaps(x, t, face);
}
