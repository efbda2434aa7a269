/*
 * The pipe to ffmpeg: a Matroska stream (RFC 9559, EBML of RFC 8794) of uncompressed pictures. Unlike plain pixels it
 * says how pictures are to be seen, and ffmpeg hands that on to the film.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* Matroska's numbers. */
enum matroska_stereo { MATROSKA_MONO = 0, MATROSKA_SIDE_BY_SIDE = 1, MATROSKA_TOP_BOTTOM = 3 }; /* the left eye first */

/* All zero: plain pictures. */
struct matroska_view {
	enum matroska_stereo stereo;
	int is_panorama; /* 1: equirectangular, 360 by 180 degrees; of two eyes each */
};

#define MATROSKA_HEADER_BYTES 512
#define MATROSKA_PICTURE_BYTES 64

/** The stream's beginning; pictures have [height][width][3] bytes. @return how many bytes it has */
size_t matroska_begin(uint8_t out[MATROSKA_HEADER_BYTES], uint32_t width, uint32_t height,
                      const struct matroska_view *view);

/** The bytes in front of a picture. @return how many they are */
size_t matroska_picture(uint8_t out[MATROSKA_PICTURE_BYTES], size_t picture_bytes, double seconds);
