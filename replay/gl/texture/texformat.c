/* Internal formats of textures and renderbuffers (GL 2.1 tables 3.15 - 3.18 and what later extensions add to them). */
#include "replay/gl/texture/texformat.h"

#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "scene/mesa.h"
#include "scene/scene.h"

/*
 * The bits that Mesa stores for each format. Formats with 8 or more bits per channel have 8 here. Smaller ones,
 * R3_G3_B2 to RGB5_A1, are stored as their names say in llvmpipe (but RGBA2 with 4 bits); luminance and alpha always
 * have 8 bits, except in LUMINANCE4_ALPHA4.
 */
#define FORMAT(name, base_format, ...) { .token = (name), .base = (base_format), __VA_ARGS__ }
static const struct gls_format formats[] = {
	FORMAT(1, GL_LUMINANCE),
	FORMAT(2, GL_LUMINANCE_ALPHA),
	FORMAT(3, GL_RGB),
	FORMAT(4, GL_RGBA),
	FORMAT(GL_LUMINANCE, GL_LUMINANCE), FORMAT(GL_LUMINANCE4, GL_LUMINANCE), FORMAT(GL_LUMINANCE8, GL_LUMINANCE),
	FORMAT(GL_LUMINANCE12, GL_LUMINANCE), FORMAT(GL_LUMINANCE16, GL_LUMINANCE),
	FORMAT(GL_LUMINANCE16F_ARB, GL_LUMINANCE, .numbers = GLS_HALF),
	FORMAT(GL_LUMINANCE32F_ARB, GL_LUMINANCE, .numbers = GLS_FLOAT),
	FORMAT(GL_LUMINANCE_SNORM, GL_LUMINANCE, .numbers = GLS_SNORM8),
	FORMAT(GL_LUMINANCE8_SNORM, GL_LUMINANCE, .numbers = GLS_SNORM8),
	FORMAT(GL_LUMINANCE16_SNORM, GL_LUMINANCE, .numbers = GLS_SNORM16), FORMAT(GL_COMPRESSED_LUMINANCE, GL_LUMINANCE),
	FORMAT(GL_SLUMINANCE, GL_LUMINANCE, .srgb = 1), FORMAT(GL_SLUMINANCE8, GL_LUMINANCE, .srgb = 1),
	FORMAT(GL_COMPRESSED_SLUMINANCE, GL_LUMINANCE, .srgb = 1),
	FORMAT(GL_LUMINANCE_ALPHA, GL_LUMINANCE_ALPHA),
	FORMAT(GL_LUMINANCE4_ALPHA4, GL_LUMINANCE_ALPHA, .bits = { 4, 4, 4, 4 }),
	FORMAT(GL_LUMINANCE6_ALPHA2, GL_LUMINANCE_ALPHA), FORMAT(GL_LUMINANCE8_ALPHA8, GL_LUMINANCE_ALPHA),
	FORMAT(GL_LUMINANCE12_ALPHA4, GL_LUMINANCE_ALPHA), FORMAT(GL_LUMINANCE12_ALPHA12, GL_LUMINANCE_ALPHA),
	FORMAT(GL_LUMINANCE16_ALPHA16, GL_LUMINANCE_ALPHA),
	FORMAT(GL_LUMINANCE_ALPHA16F_ARB, GL_LUMINANCE_ALPHA, .numbers = GLS_HALF),
	FORMAT(GL_LUMINANCE_ALPHA32F_ARB, GL_LUMINANCE_ALPHA, .numbers = GLS_FLOAT),
	FORMAT(GL_LUMINANCE_ALPHA_SNORM, GL_LUMINANCE_ALPHA, .numbers = GLS_SNORM8),
	FORMAT(GL_LUMINANCE8_ALPHA8_SNORM, GL_LUMINANCE_ALPHA, .numbers = GLS_SNORM8),
	FORMAT(GL_LUMINANCE16_ALPHA16_SNORM, GL_LUMINANCE_ALPHA, .numbers = GLS_SNORM16),
	FORMAT(GL_COMPRESSED_LUMINANCE_ALPHA, GL_LUMINANCE_ALPHA), FORMAT(GL_SLUMINANCE_ALPHA, GL_LUMINANCE_ALPHA, .srgb = 1),
	FORMAT(GL_SLUMINANCE8_ALPHA8, GL_LUMINANCE_ALPHA, .srgb = 1),
	FORMAT(GL_COMPRESSED_SLUMINANCE_ALPHA, GL_LUMINANCE_ALPHA, .srgb = 1),
	FORMAT(GL_ALPHA, GL_ALPHA), FORMAT(GL_ALPHA4, GL_ALPHA), FORMAT(GL_ALPHA8, GL_ALPHA), FORMAT(GL_ALPHA12, GL_ALPHA),
	FORMAT(GL_ALPHA16, GL_ALPHA), FORMAT(GL_ALPHA16F_ARB, GL_ALPHA, .numbers = GLS_HALF),
	FORMAT(GL_ALPHA32F_ARB, GL_ALPHA, .numbers = GLS_FLOAT), FORMAT(GL_ALPHA_SNORM, GL_ALPHA, .numbers = GLS_SNORM8),
	FORMAT(GL_ALPHA8_SNORM, GL_ALPHA, .numbers = GLS_SNORM8), FORMAT(GL_ALPHA16_SNORM, GL_ALPHA, .numbers = GLS_SNORM16),
	FORMAT(GL_COMPRESSED_ALPHA, GL_ALPHA),
	FORMAT(GL_INTENSITY, GL_INTENSITY), FORMAT(GL_INTENSITY4, GL_INTENSITY), FORMAT(GL_INTENSITY8, GL_INTENSITY),
	FORMAT(GL_INTENSITY12, GL_INTENSITY), FORMAT(GL_INTENSITY16, GL_INTENSITY),
	FORMAT(GL_INTENSITY16F_ARB, GL_INTENSITY, .numbers = GLS_HALF),
	FORMAT(GL_INTENSITY32F_ARB, GL_INTENSITY, .numbers = GLS_FLOAT),
	FORMAT(GL_INTENSITY_SNORM, GL_INTENSITY, .numbers = GLS_SNORM8),
	FORMAT(GL_INTENSITY8_SNORM, GL_INTENSITY, .numbers = GLS_SNORM8),
	FORMAT(GL_INTENSITY16_SNORM, GL_INTENSITY, .numbers = GLS_SNORM16), FORMAT(GL_COMPRESSED_INTENSITY, GL_INTENSITY),
	FORMAT(GL_RED, GL_RED), FORMAT(GL_R8, GL_RED), FORMAT(GL_R16, GL_RED), FORMAT(GL_R16F, GL_RED, .numbers = GLS_HALF),
	FORMAT(GL_R32F, GL_RED, .numbers = GLS_FLOAT), FORMAT(GL_RED_SNORM, GL_RED, .numbers = GLS_SNORM8),
	FORMAT(GL_R8_SNORM, GL_RED, .numbers = GLS_SNORM8), FORMAT(GL_R16_SNORM, GL_RED, .numbers = GLS_SNORM16),
	FORMAT(GL_COMPRESSED_RED, GL_RED),
	FORMAT(GL_RG, GL_RG), FORMAT(GL_RG8, GL_RG), FORMAT(GL_RG16, GL_RG), FORMAT(GL_RG16F, GL_RG, .numbers = GLS_HALF),
	FORMAT(GL_RG32F, GL_RG, .numbers = GLS_FLOAT), FORMAT(GL_RG_SNORM, GL_RG, .numbers = GLS_SNORM8),
	FORMAT(GL_RG8_SNORM, GL_RG, .numbers = GLS_SNORM8), FORMAT(GL_RG16_SNORM, GL_RG, .numbers = GLS_SNORM16),
	FORMAT(GL_COMPRESSED_RG, GL_RG),
	FORMAT(GL_RGB, GL_RGB), FORMAT(GL_R3_G3_B2, GL_RGB, .bits = { 3, 3, 2, 0 }),
	FORMAT(GL_RGB4, GL_RGB, .bits = { 4, 4, 4, 0 }), FORMAT(GL_RGB5, GL_RGB, .bits = { 5, 5, 5, 0 }),
	FORMAT(GL_RGB565, GL_RGB, .bits = { 5, 6, 5, 0 }), FORMAT(GL_RGB8, GL_RGB), FORMAT(GL_RGB10, GL_RGB),
	FORMAT(GL_RGB12, GL_RGB), FORMAT(GL_RGB16, GL_RGB), FORMAT(GL_RGB16F, GL_RGB, .numbers = GLS_HALF),
	FORMAT(GL_RGB32F, GL_RGB, .numbers = GLS_FLOAT), FORMAT(GL_R11F_G11F_B10F, GL_RGB, .numbers = GLS_11F),
	FORMAT(GL_RGB9_E5, GL_RGB, .numbers = GLS_9E5), FORMAT(GL_RGB_SNORM, GL_RGB, .numbers = GLS_SNORM8),
	FORMAT(GL_RGB8_SNORM, GL_RGB, .numbers = GLS_SNORM8), FORMAT(GL_RGB16_SNORM, GL_RGB, .numbers = GLS_SNORM16),
	FORMAT(GL_YCBCR_MESA, GL_RGB), FORMAT(GL_COMPRESSED_RGB, GL_RGB, .s3tc = S3TC_RGB),
	FORMAT(GL_COMPRESSED_RGB_S3TC_DXT1_EXT, GL_RGB, .block_bytes = 8, .s3tc = S3TC_RGB),
	FORMAT(GL_COMPRESSED_RGB_FXT1_3DFX, GL_RGB, .block_bytes = 16), FORMAT(GL_SRGB, GL_RGB, .srgb = 1),
	FORMAT(GL_SRGB8, GL_RGB, .srgb = 1), FORMAT(GL_COMPRESSED_SRGB, GL_RGB, .srgb = 1, .s3tc = S3TC_RGB),
	FORMAT(GL_COMPRESSED_SRGB_S3TC_DXT1_EXT, GL_RGB, .srgb = 1, .block_bytes = 8, .s3tc = S3TC_RGB),
	FORMAT(GL_RGBA, GL_RGBA), FORMAT(GL_RGBA2, GL_RGBA, .bits = { 4, 4, 4, 4 }),
	FORMAT(GL_RGBA4, GL_RGBA, .bits = { 4, 4, 4, 4 }), FORMAT(GL_RGB5_A1, GL_RGBA, .bits = { 5, 5, 5, 1 }),
	FORMAT(GL_RGBA8, GL_RGBA), FORMAT(GL_RGB10_A2, GL_RGBA, .bits = { 0, 0, 0, 2 }), FORMAT(GL_RGBA12, GL_RGBA),
	FORMAT(GL_RGBA16, GL_RGBA), FORMAT(GL_RGBA16F, GL_RGBA, .numbers = GLS_HALF),
	FORMAT(GL_RGBA32F, GL_RGBA, .numbers = GLS_FLOAT), FORMAT(GL_RGBA_SNORM, GL_RGBA, .numbers = GLS_SNORM8),
	FORMAT(GL_RGBA8_SNORM, GL_RGBA, .numbers = GLS_SNORM8), FORMAT(GL_RGBA16_SNORM, GL_RGBA, .numbers = GLS_SNORM16),
	FORMAT(GL_COMPRESSED_RGBA, GL_RGBA, .s3tc = S3TC_LEVELS),
	FORMAT(GL_COMPRESSED_RGBA_S3TC_DXT1_EXT, GL_RGBA, .block_bytes = 8, .s3tc = S3TC_RGBA),
	FORMAT(GL_COMPRESSED_RGBA_S3TC_DXT3_EXT, GL_RGBA, .block_bytes = 16, .s3tc = S3TC_BITS),
	FORMAT(GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, GL_RGBA, .block_bytes = 16, .s3tc = S3TC_LEVELS),
	FORMAT(GL_COMPRESSED_RGBA_FXT1_3DFX, GL_RGBA, .block_bytes = 16), FORMAT(GL_SRGB_ALPHA, GL_RGBA, .srgb = 1),
	FORMAT(GL_SRGB8_ALPHA8, GL_RGBA, .srgb = 1), FORMAT(GL_COMPRESSED_SRGB_ALPHA, GL_RGBA, .srgb = 1, .s3tc = S3TC_LEVELS),
	FORMAT(GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT, GL_RGBA, .srgb = 1, .block_bytes = 8, .s3tc = S3TC_RGBA),
	FORMAT(GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT, GL_RGBA, .srgb = 1, .block_bytes = 16, .s3tc = S3TC_BITS),
	FORMAT(GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT, GL_RGBA, .srgb = 1, .block_bytes = 16, .s3tc = S3TC_LEVELS),
	FORMAT(GL_COMPRESSED_RGBA_BPTC_UNORM, GL_RGBA), FORMAT(GL_COMPRESSED_SRGB_ALPHA_BPTC_UNORM, GL_RGBA, .srgb = 1),
	FORMAT(GL_COMPRESSED_RGB_BPTC_SIGNED_FLOAT, GL_RGB), FORMAT(GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT, GL_RGB),
	FORMAT(GL_COMPRESSED_RED_RGTC1, GL_RED, .block_bytes = 8),
	FORMAT(GL_COMPRESSED_SIGNED_RED_RGTC1, GL_RED, .block_bytes = 8, .numbers = GLS_SNORM8),
	FORMAT(GL_COMPRESSED_RG_RGTC2, GL_RG, .block_bytes = 16),
	FORMAT(GL_COMPRESSED_SIGNED_RG_RGTC2, GL_RG, .block_bytes = 16, .numbers = GLS_SNORM8),
	FORMAT(GL_COMPRESSED_LUMINANCE_LATC1_EXT, GL_LUMINANCE, .block_bytes = 8),
	FORMAT(GL_COMPRESSED_SIGNED_LUMINANCE_LATC1_EXT, GL_LUMINANCE, .block_bytes = 8, .numbers = GLS_SNORM8),
	FORMAT(GL_COMPRESSED_LUMINANCE_ALPHA_LATC2_EXT, GL_LUMINANCE_ALPHA, .block_bytes = 16),
	FORMAT(GL_COMPRESSED_SIGNED_LUMINANCE_ALPHA_LATC2_EXT, GL_LUMINANCE_ALPHA, .block_bytes = 16, .numbers = GLS_SNORM8),
	FORMAT(GL_COMPRESSED_LUMINANCE_ALPHA_3DC_ATI, GL_LUMINANCE_ALPHA, .block_bytes = 16),
	FORMAT(GL_DEPTH_COMPONENT, GL_DEPTH_COMPONENT), FORMAT(GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT),
	FORMAT(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT), FORMAT(GL_DEPTH_COMPONENT32, GL_DEPTH_COMPONENT),
	FORMAT(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT), FORMAT(GL_DEPTH_STENCIL, GL_DEPTH_COMPONENT),
	FORMAT(GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT), FORMAT(GL_DEPTH32F_STENCIL8, GL_DEPTH_COMPONENT),
};
#undef FORMAT

const struct gls_format *gls_format_find(uint32_t internal_format)
{
	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
		if (formats[i].token == internal_format)
			return &formats[i];
	return NULL;
}

uint32_t gls_block_width(const struct gls_format *f)
{
	return f->token == GL_COMPRESSED_RGB_FXT1_3DFX || f->token == GL_COMPRESSED_RGBA_FXT1_3DFX ? 8 : 4;
}

uint32_t gls_base_format(uint32_t internal_format)
{
	const struct gls_format *f = gls_format_find(internal_format);

	return f ? f->base : 0;
}

uint32_t gls_format_depth_bits(uint32_t internal_format)
{
	if (gls_base_format(internal_format) != GL_DEPTH_COMPONENT)
		return 0;
	return internal_format == GL_DEPTH_COMPONENT16 ? 16 : 24;
}

uint32_t gls_format_stencil_bits(uint32_t internal_format)
{
	return internal_format == GL_DEPTH_STENCIL || internal_format == GL_DEPTH24_STENCIL8 ||
	                       internal_format == GL_DEPTH32F_STENCIL8 || internal_format == GL_STENCIL_INDEX ||
	                       (internal_format >= GL_STENCIL_INDEX1 && internal_format <= GL_STENCIL_INDEX16) ?
	               8 :
	               0;
}

/* A colour as sampling a base format returns it (table 3.20). */
static void expand(uint32_t base, const float color[4], float out[4])
{
	int has_color = base != GL_ALPHA, one = base == GL_LUMINANCE || base == GL_LUMINANCE_ALPHA || base == GL_INTENSITY;

	out[0] = has_color ? color[0] : 0;
	out[1] = !has_color || base == GL_RED ? 0 : one ? color[0] : color[1];
	out[2] = !has_color || base == GL_RED || base == GL_RG ? 0 : one ? color[0] : color[2];
	out[3] = base == GL_INTENSITY                                              ? color[0] :
	         base == GL_ALPHA || base == GL_LUMINANCE_ALPHA || base == GL_RGBA ? color[3] :
	                                                                             1;
	if (base == GL_DEPTH_COMPONENT)
		out[0] = color[0];
}

uint32_t gls_format_floats(uint32_t internal_format)
{
	const struct gls_format *f = gls_format_find(internal_format);

	return !f || f->numbers < GLS_FLOAT ? 0 : f->numbers == GLS_HALF ? SCENE_HALVES : SCENE_FLOATS;
}

uint32_t gls_format_is_srgb(uint32_t internal_format)
{
	const struct gls_format *f = gls_format_find(internal_format);

	return f && f->srgb;
}

uint32_t gls_texel_bytes(uint32_t internal_format)
{
	const struct gls_format *f = gls_format_find(internal_format);

	return f && f->numbers ? 16 : 4;
}

/* Expand to eight bits by repetition. */
static uint8_t widen(unsigned value, unsigned bits)
{
	unsigned v = value << (8 - bits);

	for (unsigned n = bits; n < 8; n *= 2)
		v |= v >> n;
	return (uint8_t)v;
}

/* A number as 8 bits, after rounding it to fewer. */
static uint8_t coarse(float value, unsigned bits)
{
	float steps = (float)((1u << bits) - 1);

	value = value <= 0 || value != value ? 0 : value >= 1 ? 1 : value;
	return widen((unsigned)(value * steps + 0.5f), bits);
}

/*
 * A float rounded to this number of mantissa bits and 5 exponent bits; with the lowest exponent there is no leading
 * one.
 */
static float few_bits(float value, int bits, int rounds)
{
	int exponent;
	float step;

	frexpf(value, &exponent);
	step = ldexpf(1, (exponent > -13 ? exponent : -13) - 1 - bits);
	return (rounds ? rintf(value / step) : truncf(value / step)) * step;
}

/*
 * Round numbers to a format. EXT_packed_float and EXT_texture_shared_exponent do not specify the rounding: it is
 * Mesa's.
 */
static void hold(uint32_t numbers, uint32_t mesa, float v[4])
{
	const int rounds = (mesa & SCENE_MESA_ROUNDS_SMALL_FLOATS) != 0;
	float steps = numbers == GLS_SNORM8 ? 127 : 32767, most = 0, step;

	switch (numbers) {
	case GLS_SNORM8:
	case GLS_SNORM16:
		for (unsigned i = 0; i < 4; i++)
			v[i] = rintf((v[i] > -1 ? v[i] < 1 ? v[i] : 1 : -1) * steps) * (1 / steps);
		break;
	case GLS_HALF:
		for (unsigned i = 0; i < 4; i++) {
			v[i] = isfinite(v[i]) ? few_bits(v[i], 10, 1) : v[i];
			v[i] = fabsf(v[i]) < 65520 ? v[i] : copysignf(INFINITY, v[i]);
		}
		break;
	case GLS_11F:
		for (unsigned i = 0; i < 3; i++) {
			float largest = i < 2 ? 65024 : 64512;

			v[i] = v[i] > 0 ? v[i] < largest ? few_bits(v[i], i < 2 ? 6 : 5, rounds) : largest : 0;
		}
		break;
	case GLS_9E5:
		for (unsigned i = 0; i < 3; i++) {
			v[i] = v[i] > 0 ? v[i] < 65408 ? v[i] : 65408 : 0;
			most = v[i] > most ? v[i] : most;
		}
		/* nine bits for the largest, the others in the same steps */
		for (step = ldexpf(1, (most >= ldexpf(1, -16) ? ilogbf(most) : -16) - 8); floorf(most / step + 0.5f) > 511;)
			step *= 2;
		for (unsigned i = 0; i < 3; i++)
			v[i] = floorf(v[i] / step + 0.5f) * step;
		break;
	}
}

void gls_format_store_bytes(const struct gls_format *f, const float rgba[4], uint8_t out[4])
{
	float v[4];

	expand(f->base, rgba, v);
	for (unsigned i = 0; i < 4; i++)
		out[i] = f->bits[i] ? coarse(v[i], f->bits[i]) : gls_byte(v[i]);
}

void gls_format_store(const struct gls_format *f, const float rgba[4], uint32_t mesa, uint8_t *out)
{
	float v[4];

	if (!f->numbers) {
		gls_format_store_bytes(f, rgba, out);
		return;
	}
	expand(f->base, rgba, v);
	hold(f->numbers, mesa, v);
	memcpy(out, v, sizeof(v));
}

/* Reduce 8 bits as llvmpipe does when drawing: to more than four by truncation, to four or fewer by rounding. */
static uint8_t drawn(unsigned v, unsigned bits)
{
	return widen(bits > 4 ? v >> (8 - bits) : ((v >> bits) * ((1u << bits) - 1) + (1u << (7 - bits))) >> (8 - bits), bits);
}

void gls_format_draw(const struct gls_format *f, const float rgba[4], uint8_t *out)
{
	float v[4];

	gls_format_store(f, rgba, 0, out);
	expand(f->base, rgba, v);
	for (unsigned i = 0; i < 4 && f->bits[0]; i++)
		if (f->bits[i] && f->bits[i] != 4)
			out[i] = drawn(gls_byte(v[i]), f->bits[i]);
}

void gls_format_border(uint32_t internal_format, const float color[4], float out[4])
{
	const struct gls_format *f = gls_format_find(internal_format);
	int floats = f->numbers >= GLS_FLOAT, low = f->numbers && f->numbers <= GLS_SNORM16 ? -1 : 0;

	expand(f->base, color, out);
	for (unsigned i = 0; i < 4 && f->numbers != GLS_FLOAT && f->numbers != GLS_HALF; i++) {
		out[i] = out[i] > (float)low ? out[i] : (float)low;
		out[i] = out[i] < 1 || floats ? out[i] : 1;
	}
}

void gls_texel_load(uint32_t texel_bytes, const uint8_t *texel, float out[4])
{
	if (texel_bytes == 16)
		memcpy(out, texel, 16);
	for (unsigned i = 0; i < 4 && texel_bytes == 4; i++)
		out[i] = (float)texel[i] / 255;
}

/* Equation 3.16b of EXT_texture_sRGB. */
float gls_linear_from_srgb(float c)
{
	return c <= 0.04045f ? c / 12.92f : powf((c + 0.055f) / 1.055f, 2.4f);
}

float gls_srgb_from_linear(float c)
{
	return c <= 0.0031308f ? c * 12.92f : 1.055f * powf(c, 1 / 2.4f) - 0.055f;
}

void gls_encode_color(float color[4])
{
	for (unsigned i = 0; i < 3; i++)
		color[i] = gls_srgb_from_linear(color[i] > 0 ? color[i] < 1 ? color[i] : 1 : 0);
}
