/*
 * Compressed textures (GL 2.1 sec. 3.8.3): decodes blocks of EXT_texture_compression_s3tc,
 * 3DFX_texture_compression_FXT1, ARB_texture_compression_rgtc, EXT_texture_compression_latc and
 * ATI_texture_compression_3dc to texels.
 *
 * Bits are numbered as in the extensions: bit 0 is the lowest of the first byte.
 */
#include "replay/gl/texture/texcompress.h"

#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/texture/texformat.h"

struct rgba {
	unsigned v[4];
};

static unsigned bits_at(const uint8_t *block, unsigned first, unsigned n)
{
	unsigned value = 0;

	for (unsigned i = 0; i < n; i++)
		value |= (unsigned)(block[(first + i) / 8] >> (first + i) % 8 & 1) << i;
	return value;
}

/* Expand to eight bits by repeating the highest bits. */
static unsigned wide(unsigned value, unsigned bits)
{
	return (value << (8 - bits) | value >> (2 * bits - 8)) & 255;
}

/* Interpolate two numbers by part / of, as llvmpipe does: by 255ths over 256, rounded down. */
static int between(int a, int b, int part, int of)
{
	return a + (((b - a) * (part * 255 / of)) >> 8);
}

static struct rgba third(struct rgba a, struct rgba b, int part)
{
	for (unsigned i = 0; i < 4; i++)
		a.v[i] = (unsigned)between((int)a.v[i], (int)b.v[i], part, 3);
	return a;
}

/* Interpolate for FXT1, as Mesa does: rounded to nearest, halves down. */
static struct rgba blend(struct rgba a, struct rgba b, unsigned part, unsigned of)
{
	for (unsigned i = 0; i < 4; i++)
		a.v[i] = (a.v[i] * (of - part) + b.v[i] * part + (of > 2 ? of / 2 : 0)) / of;
	return a;
}

static void put(const struct rgba *c, uint8_t *out)
{
	for (unsigned i = 0; i < 4; i++)
		out[i] = (uint8_t)c->v[i];
}

/* ---- S3TC: 4x4 texels ---- */

static struct rgba color_565(unsigned word)
{
	return (struct rgba){ { wide(word >> 11, 5), wide(word >> 5 & 63, 6), wide(word & 31, 5), 255 } };
}

/* Colours of a block of 8 bytes. through: the fourth colour may be transparent; four: there are always four colours */
static void s3tc_colors(const uint8_t *block, int through, int four, uint8_t out[16][4])
{
	unsigned w0 = bits_at(block, 0, 16), w1 = bits_at(block, 16, 16);
	struct rgba c[4] = { color_565(w0), color_565(w1) };

	if (four || w0 > w1) {
		c[2] = third(c[0], c[1], 1);
		c[3] = third(c[0], c[1], 2);
	} else {
		for (unsigned i = 0; i < 4; i++)
			c[2].v[i] = (c[0].v[i] + c[1].v[i] + 1) / 2;
		c[3] = (struct rgba){ { 0, 0, 0, through ? 0 : 255 } };
	}
	for (unsigned i = 0; i < 16; i++)
		put(&c[bits_at(block, 32 + 2 * i, 2)], out[i]);
}

/* Alpha of DXT5 and channels of RGTC: eight levels between two numbers; or six, followed by the minimum and maximum. */
static int channel(const uint8_t *block, unsigned i, int is_signed)
{
	int a0 = is_signed ? (int8_t)block[0] : block[0], a1 = is_signed ? (int8_t)block[1] : block[1];
	int code = (int)bits_at(block, 16 + 3 * i, 3);

	if (code < 2)
		return code ? a1 : a0;
	if (a0 > a1 || code < 6)
		return between(a0, a1, code - 1, a0 > a1 ? 7 : 5);
	return code == 6 ? (is_signed ? -127 : 0) : is_signed ? 127 : 255;
}

static void s3tc_block(enum s3tc_kind kind, const uint8_t *block, uint8_t out[16][4])
{
	const int has_alpha = kind == S3TC_BITS || kind == S3TC_LEVELS;

	s3tc_colors(block + 8 * has_alpha, kind == S3TC_RGBA, has_alpha, out);
	for (unsigned i = 0; i < 16 && has_alpha; i++)
		out[i][3] = (uint8_t)(kind == S3TC_BITS ? wide(bits_at(block, 4 * i, 4), 4) : (unsigned)channel(block, i, 0));
}

/* ---- FXT1: 8x4 texels, first the sixteen of the left half ---- */

/* Expand to eight bits, rounded. */
static unsigned scaled(unsigned value, unsigned bits)
{
	unsigned most = (1u << bits) - 1;

	return (value * 255 + most / 2) / most;
}

static struct rgba color_555(const uint8_t *block, unsigned first)
{
	return (struct rgba){ { scaled(bits_at(block, first + 10, 5), 5), scaled(bits_at(block, first + 5, 5), 5),
		                scaled(bits_at(block, first, 5), 5), 255 } };
}

/* A 555 colour with a sixth bit of green. */
static struct rgba color_555_1(const uint8_t *block, unsigned first, unsigned low)
{
	struct rgba c = color_555(block, first);

	c.v[1] = scaled(bits_at(block, first + 5, 5) << 1 | low, 6);
	return c;
}

static struct rgba fxt1_mixed(const uint8_t *block, unsigned t)
{
	unsigned right = t / 16, code = bits_at(block, 2 * t, 2), low = bits_at(block, 125 + right, 1),
		 first = 64 + 30 * right;
	struct rgba c0, c1 = color_555_1(block, first + 15, low), none = { { 0, 0, 0, 0 } };

	if (bits_at(block, 124, 1)) {
		c0 = color_555(block, first);
		return code == 3 ? none : blend(c0, c1, code, 2);
	}
	c0 = color_555_1(block, first, low ^ bits_at(block, 32 * right + 1, 1));
	return blend(c0, c1, code, 3);
}

static struct rgba fxt1_alpha(const uint8_t *block, unsigned t)
{
	unsigned code = bits_at(block, 2 * t, 2);
	struct rgba c[4] = { color_555(block, 64), color_555(block, 79), color_555(block, 94), { { 0, 0, 0, 0 } } };

	for (unsigned i = 0; i < 3; i++)
		c[i].v[3] = scaled(bits_at(block, 109 + 5 * i, 5), 5);
	return bits_at(block, 124, 1) ? blend(c[t < 16 ? 0 : 2], c[1], code, 3) : c[code];
}

static struct rgba fxt1_texel(const uint8_t *block, unsigned t)
{
	unsigned code;

	if (bits_at(block, 127, 1))
		return fxt1_mixed(block, t);
	if (!bits_at(block, 126, 1)) {
		code = bits_at(block, 3 * t, 3);
		return code == 7 ? (struct rgba){ { 0, 0, 0, 0 } } : blend(color_555(block, 96), color_555(block, 111), code, 6);
	}
	if (bits_at(block, 125, 1))
		return fxt1_alpha(block, t);
	return color_555(block, 64 + 15 * bits_at(block, 2 * t, 2));
}

static void fxt1_block(uint32_t format, const uint8_t *block, uint8_t out[32][4])
{
	for (unsigned i = 0; i < 32; i++) {
		struct rgba c = fxt1_texel(block, i % 8 / 4 * 16 + i / 8 * 4 + i % 4);

		put(&c, out[i]);
		if (format == GL_COMPRESSED_RGB_FXT1_3DFX)
			out[i][3] = 255;
	}
}

/* ---- RGTC, LATC and 3DC: 4x4 texels with one or two channels ---- */

static int is_rgtc(uint32_t base)
{
	return base == GL_RED || base == GL_RG || base == GL_LUMINANCE || base == GL_LUMINANCE_ALPHA;
}

static void rgtc_texel(const struct gls_format *f, const uint8_t *block, unsigned i, uint8_t *out)
{
	const int is_signed = f->numbers == GLS_SNORM8;
	const float most = is_signed ? 127 : 255;
	float v[4] = { (float)channel(block, i, is_signed) / most, 0, 0, 1 };

	if (f->block_bytes == 16)
		v[f->base == GL_RG ? 1 : 3] = (float)channel(block + 8, i, is_signed) / most;
	gls_format_store(f, v, 0, out);
}

int gls_decompress(uint32_t internal_format, uint32_t width, uint32_t height, const uint8_t *data, size_t n,
                   uint8_t *out)
{
	const struct gls_format *f = gls_format_find(internal_format);
	const uint32_t side = f ? gls_block_width(f) : 4, columns = (width + side - 1) / side,
		       bytes = gls_texel_bytes(internal_format);
	uint8_t texels[32][4];

	if (!f || !f->block_bytes || n / f->block_bytes / (columns + !columns) < (height + 3) / 4)
		return -1;
	for (uint32_t y = 0; y < height; y += 4)
		for (uint32_t x = 0; x < width; x += side, data += f->block_bytes) {
			if (side == 8)
				fxt1_block(internal_format, data, texels);
			else if (!is_rgtc(f->base))
				s3tc_block(f->s3tc, data, texels);
			for (uint32_t i = 0; i < 4 * side; i++) {
				uint8_t *to = out + bytes * ((size_t)(y + i / side) * width + x + i % side);

				if (x + i % side >= width || y + i / side >= height)
					continue;
				if (is_rgtc(f->base))
					rgtc_texel(f, data, i, to);
				else
					memcpy(to, texels[i], 4);
			}
		}
	return 0;
}

void gls_recompress(const struct gls_format *f, uint32_t width, uint32_t height, uint32_t row, uint8_t *texels)
{
	for (uint32_t y = 0; y < height && f->s3tc; y += 4)
		for (uint32_t x = 0; x < width; x += 4) {
			struct s3tc_texels t = { width - x < 4 ? width - x : 4, height - y < 4 ? height - y : 4, { { { 0 } } } };
			uint8_t block[16], left[16][4];

			for (uint32_t i = 0; i < t.height; i++)
				memcpy(t.rgba[i], texels + 4 * ((size_t)(y + i) * row + x), 4 * t.width);
			s3tc_encode(f->s3tc, &t, block);
			s3tc_block(f->s3tc, block, left);
			for (uint32_t i = 0; i < t.height; i++)
				memcpy(texels + 4 * ((size_t)(y + i) * row + x), left[4 * i], 4 * t.width);
		}
}
