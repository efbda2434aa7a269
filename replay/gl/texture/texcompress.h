/* Block-compressed images (GL 2.1 sec. 3.8.3): S3TC, RGTC, LATC, FXT1. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "replay/gl/texture/texformat.h"

/**
 * Decode a compressed 2D image to texels of its internal format.
 * @param n    size of data in bytes
 * @param out  width * height texels
 * @return 0; -1: too few bytes, or another format
 */
int gls_decompress(uint32_t internal_format, uint32_t width, uint32_t height, const uint8_t *data, size_t n,
                   uint8_t *out);

/**
 * Apply the loss of Mesa's compression to a plain 2D image with 8 bits per channel; does nothing for formats that are
 * not compressed.
 * @param row  texels from one row to the next
 */
void gls_recompress(const struct gls_format *f, uint32_t width, uint32_t height, uint32_t row, uint8_t *texels);
