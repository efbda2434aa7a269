/* Conversion of YCbCr pixels (MESA_ycbcr_texture), where each two share Cb and Cr, to texels. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/**
 * Convert one texel of a row, exactly as llvmpipe (22.3.6) does.
 * @param n    number of bytes available in the row
 * @param low  which byte of each pair is luma; the others are Cb and Cr alternately
 * @param out  RGBA
 * @return 0; -2: its bytes are not available, and it is 0
 */
int gls_ycbcr_texel(const uint8_t *row, size_t n, uint32_t x, unsigned low, uint8_t out[4]);
