/*
 * Internal formats of textures and renderbuffers: what is kept of a colour. A texel is 4 bytes RGBA, or 4 floats where
 * its format holds numbers beyond [0,1]; a depth is one float.
 */
#pragma once

#include <stdint.h>

#include "replay/gl/texture/s3tc.h"

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
	uint8_t s3tc;         /* enum s3tc_kind: what its blocks are, and what Mesa compresses plain images to */
	uint8_t numbers; /* enum gls_numbers */
};

/* What numbers the texels of a format can hold. All but bytes are stored as floats. */
enum gls_numbers { GLS_BYTES, GLS_SNORM8, GLS_SNORM16, GLS_FLOAT, GLS_HALF, GLS_11F, GLS_9E5 };

/** NULL: fixed function could sample no such format. */
const struct gls_format *gls_format_find(uint32_t internal_format);
/** How wide a compressed format's blocks are, texels; all are 4 high. */
uint32_t gls_block_width(const struct gls_format *f);
/** Base format of an internal format, 0: none. */
uint32_t gls_base_format(uint32_t internal_format);
/** Depth and stencil bits of a surface that such a texture or renderbuffer is attached to. */
uint32_t gls_format_depth_bits(uint32_t internal_format);
uint32_t gls_format_stencil_bits(uint32_t internal_format);
/** What a surface holds that such a texture or renderbuffer is attached to: SCENE_FLOATS, SCENE_HALVES or 0, codes. */
uint32_t gls_format_floats(uint32_t internal_format);
/** Bytes of a texel: 4, or 16 where it is four floats. */
uint32_t gls_texel_bytes(uint32_t internal_format);
/**
 * A colour as a texel, rounded to what the format can hold, expanded as sampling does (table 3.20).
 * @param mesa  as the Mesa rounds what a program hands over: bits of enum scene_mesa; 0: what it made itself
 */
void gls_format_store(const struct gls_format *f, const float rgba[4], uint32_t mesa, uint8_t *out);
/** The same of a colour that was drawn. */
void gls_format_draw(const struct gls_format *f, const float rgba[4], uint8_t *out);
/** The same as gls_format_store in four bytes, whatever the format. */
void gls_format_store_bytes(const struct gls_format *f, const float rgba[4], uint8_t out[4]);
/** What a texel holds. */
void gls_texel_load(uint32_t texel_bytes, const uint8_t *texel, float out[4]);
/** A border colour as sampling this format gives it: no number that its texels could not be. */
void gls_format_border(uint32_t internal_format, const float color[4], float out[4]);
/** One channel in [0,1] (EXT_texture_sRGB, IEC 61966-2-1). */
float gls_linear_from_srgb(float c);
float gls_srgb_from_linear(float c);
/** The first three in place, clamped. */
void gls_encode_color(float color[4]);
/** 1 where colours of a format are encoded so. */
uint32_t gls_format_is_srgb(uint32_t internal_format);
