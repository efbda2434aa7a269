/*
 * The stream that is piped to ffmpeg: uncompressed pictures in Matroska (RFC 9559; EBML: RFC 8794). Unlike raw pixels,
 * it can say that pictures are panoramas or for two eyes, and ffmpeg copies that into the film.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* Matroska's numbers. */
enum matroska_stereo { MATROSKA_MONO = 0, MATROSKA_SIDE_BY_SIDE = 1, MATROSKA_TOP_BOTTOM = 3 }; /* the left eye first */

/* All zero: plain pictures. */
struct matroska_view {
	enum matroska_stereo stereo;
	int is_panorama; /* 1: equirectangular, 360 by 180 degrees for each eye */
};

#define MATROSKA_HEADER_BYTES 512
#define MATROSKA_PICTURE_BYTES 64

/** Write the start of the stream; pictures have [height][width][3] bytes. @return its number of bytes */
size_t matroska_begin(uint8_t out[MATROSKA_HEADER_BYTES], uint32_t width, uint32_t height,
                      const struct matroska_view *view);

/** Write the bytes that precede a picture. @return their number */
size_t matroska_picture(uint8_t out[MATROSKA_PICTURE_BYTES], size_t picture_bytes, double seconds);
