/*
 * Internal formats of textures and renderbuffers, with the precision that colours are stored with. A texel is 4 bytes
 * RGBA, or 4 floats if the format can hold numbers outside [0,1]; a depth is one float.
 */
#pragma once

#include <stdint.h>

#include "replay/gl/texture/s3tc.h"

/* A number in [0,1] as 8 bits. */
static inline uint8_t gls_byte(float value)
{
	float v = value > 0 ? value : 0; /* this form maps NaN to 0 without a branch */

	v = v < 1 ? v : 1;
	return (uint8_t)(v * 255.0f + 0.5f);
}

struct gls_format {
	uint32_t token, base; /* base: table 3.15, and RED and RG (ARB_texture_rg) */
	uint8_t bits[4];      /* for R G B A (L and I: in R) if fewer than 8 are stored; 0: 8 */
	uint8_t srgb;         /* 1: colours are sRGB-encoded, and sampled in linear light */
	uint8_t block_bytes;  /* size of 4x4 texels (8x4 for FXT1) in client memory if compressed; else 0 */
	uint8_t s3tc;         /* enum s3tc_kind: the format of its blocks, and of Mesa's compression of plain images */
	uint8_t numbers; /* enum gls_numbers */
};

/* The kind of numbers in a format's texels. All except bytes are stored as floats. */
enum gls_numbers { GLS_BYTES, GLS_SNORM8, GLS_SNORM16, GLS_FLOAT, GLS_HALF, GLS_11F, GLS_9E5 };

/** @return NULL: not a format that fixed function can sample */
const struct gls_format *gls_format_find(uint32_t internal_format);
/** Width of a compressed format's blocks in texels; all are 4 high. */
uint32_t gls_block_width(const struct gls_format *f);
/** Base format of an internal format, 0: none. */
uint32_t gls_base_format(uint32_t internal_format);
/** Depth and stencil bits of a surface with such a texture or renderbuffer attached. */
uint32_t gls_format_depth_bits(uint32_t internal_format);
uint32_t gls_format_stencil_bits(uint32_t internal_format);
/** Contents of a surface with such a texture or renderbuffer attached: SCENE_FLOATS, SCENE_HALVES or 0, codes. */
uint32_t gls_format_floats(uint32_t internal_format);
/** Bytes of a texel: 4, or 16 if it has four floats. */
uint32_t gls_texel_bytes(uint32_t internal_format);
/**
 * Convert a colour to a texel, rounded to what the format can hold, and expanded as in sampling (table 3.20).
 * @param mesa  selects the rounding of values passed by a program: bits of enum scene_mesa; 0: of values that were
 *              computed
 */
void gls_format_store(const struct gls_format *f, const float rgba[4], uint32_t mesa, uint8_t *out);
/** As gls_format_store, for a colour that was drawn. */
void gls_format_draw(const struct gls_format *f, const float rgba[4], uint8_t *out);
/** As gls_format_store, but always to four bytes. */
void gls_format_store_bytes(const struct gls_format *f, const float rgba[4], uint8_t out[4]);
/** The value of a texel. */
void gls_texel_load(uint32_t texel_bytes, const uint8_t *texel, float out[4]);
/** A border colour as sampling this format returns it: limited to what its texels can hold. */
void gls_format_border(uint32_t internal_format, const float color[4], float out[4]);
/** One channel in [0,1] (EXT_texture_sRGB, IEC 61966-2-1). */
float gls_linear_from_srgb(float c);
float gls_srgb_from_linear(float c);
/** Encode the first three components in place, clamped. */
void gls_encode_color(float color[4]);
/** 1 if a format's colours are sRGB-encoded. */
uint32_t gls_format_is_srgb(uint32_t internal_format);
