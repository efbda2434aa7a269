/*
 * Runs inside the traced program. Pixels that the program hands over or reads back: as the pixel store state lays them
 * out in its memory, or as an offset in a buffer object.
 */
#pragma once

#include <stdint.h>

#include "capture/format/sizes.h"

/** 1 if pixel pointers are offsets in a bound unpack buffer. */
int pixels_in_buffer(void);

/** Pixels in client memory, or the offset. */
uint8_t *put_image(uint8_t *p, const void *pixels, const struct pixel_box *box);
/**
 * Before and after a call that passes pixels to GL. Repeated pixels are stored once (content.h): the call then gets an
 * offset in a buffer that holds them.
 */
void pixels_used(const void *pixels, const struct pixel_box *box);
void pixels_written(void);

long pixels_stipple_count(void);

/*
 * Number of bytes that the program has read back; -1: not into memory, or unknown. The bytes are not needed to draw the
 * trace, but to study the program. Query after the call.
 */
long pixels_read_bytes(unsigned format, unsigned type, int width, int height);
long pixels_texture_bytes(unsigned target, int level, unsigned format, unsigned type);
long pixels_compressed_bytes(unsigned target, int level);
/** The `bytes` bytes that a call has returned; if negative, only their address, or offset in a buffer. */
uint8_t *put_returned(uint8_t *p, const void *data, long bytes);
