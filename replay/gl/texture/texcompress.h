#ifndef REPLAY_GL_TEXTURE_TEXCOMPRESS_H
#define REPLAY_GL_TEXTURE_TEXCOMPRESS_H

#include <stddef.h>
#include <stdint.h>

/** Whatever the client's format was, a block-compressed image as texels of the internal format. @return 0; -1: too few bytes */
int gls_decompress(uint32_t internal_format, uint32_t width, uint32_t height, const uint8_t *data, size_t n, uint8_t *out);

#endif
