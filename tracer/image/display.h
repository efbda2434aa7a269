/*
 * Display pictures: 8-bit codes for a screen, as PNG or JPEG, from linear light x.
 *
 *     y = x 2^exposure
 *     y = K + (1 - K) m t / (1 + (m - 1) t)    if y > K = 0.6;  t = (y - K) / (white - K), at most 1;
 *                                              m = (white - K) / (1 - K)
 *     code = floor(255 sRGB(y) + 1/2 + d)      d: an ordered dither of 8 x 8 pixels, within 0.45; 0 if off
 *
 * The shoulder begins smoothly at K and reaches 1 at `white`. With white = 1 it is a straight line, so GL's picture is
 * unchanged. The dither is below half a code, so areas whose colour is exactly a code stay uniform. A code depends only
 * on its own pixel, never on other pixels or frames.
 */
#pragma once

#include <stdint.h>

#include "tracer/image/image.h"
#include "tracer/image/oiio.h"

enum display_kind { DISPLAY_NONE, DISPLAY_EXR, DISPLAY_PNG, DISPLAY_JPEG };

/** File format by the extension of a file name. DISPLAY_NONE: not a format that can be written, or nothing but an
 * extension. */
enum display_kind display_kind_of(const char *path);

/** Report that a file name has another extension, with the extensions that are known. @return ERR_USAGE */
int display_refuse(const char *path);

struct display_options {
	float exposure; /* stops */
	float white;    /* linear light after exposure that is shown as white; at least 1 */
	int rounds;     /* 1: round codes, as GL does; 0: dither them */
};

struct display;

/** @return 0 or ERR_SYSTEM (reported) */
int display_create(const struct display_options *options, struct display **out);
void display_destroy(struct display **display);

/**
 * Compute the display codes of three channels.
 * @param img    image; its attribute relume:encoding says whether the channels are linear
 * @param layer  "" for R, G, B; "gl." for gl.R, gl.G, gl.B
 * @param rgb    [height][width][3]
 * @param over   NULL, or receives the number of pixels with a channel brighter than white
 * @return 0, or ERR_INPUT (reported): there are no such channels
 */
int display_codes(const struct display *display, const struct image *img, const char *layer, uint8_t *rgb,
                  uint64_t *over);

/** Write codes to a file, which appears complete or not at all. @return 0 or ERR_SYSTEM (reported) */
int display_save(const struct oiio_pixels *pixels, const struct oiio_coding *coding, const char *path);

/**
 * Write R, G, B as a display picture, which appears complete or not at all. Its description has the picture's frame,
 * trace, settings, version and device, one per line, for oiio_read. The same picture gives the same bytes.
 * @param path  ends in .png, .jpg or .jpeg
 * @param over  as display_codes
 * @return 0 or ERR_SYSTEM (reported)
 */
int display_write(const struct display *display, const struct image *img, const char *path, uint64_t *over);
