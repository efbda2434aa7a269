/* Pixels of brightness, two and two with one colour (MESA_ycbcr_texture), as texels. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/**
 * A texel of a row of them, to the bits of llvmpipe (22.3.6).
 * @param n    bytes of the row that are there
 * @param low  which byte of each two is brightness; the other ones are Cb and Cr in turn
 * @param out  RGBA
 * @return 0; -2: its bytes are not there, and it is 0
 */
int gls_ycbcr_texel(const uint8_t *row, size_t n, uint32_t x, unsigned low, uint8_t out[4]);
