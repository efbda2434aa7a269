/*
 * Display pictures: 8-bit codes for a screen, as PNG or JPEG, from linear light x.
 *
 *     y = x 2^exposure
 *     y = K + (1 - K) m t / (1 + (m - 1) t)    where y > K = 0.6;  t = (y - K) / (white - K), at most 1;
 *                                              m = (white - K) / (1 - K)
 *     code = floor(255 sRGB(y) + 1/2 + d)      d: an ordered dither of 8 x 8 pixels, within 0.45; 0 where it is not
 *                                              wanted
 *
 * The shoulder begins smoothly at K and reaches 1 at `white`. With white 1 it is a straight line: what GL drew looks as
 * it did. The dither is below half a code, so areas of a colour that has a code of its own stay plain. A code depends
 * on its pixel alone, never on other pixels or frames.
 */
#pragma once

#include <stdint.h>

#include "tracer/image/image.h"
#include "tracer/image/oiio.h"

enum display_kind { DISPLAY_NONE, DISPLAY_EXR, DISPLAY_PNG, DISPLAY_JPEG };

/** What a file name's ending says. DISPLAY_NONE: none that can be written. */
enum display_kind display_kind_of(const char *path);

/** Report that a file name ends otherwise, with the endings that are known. @return ERR_USAGE */
int display_refuse(const char *path);

struct display_options {
	float exposure; /* stops */
	float white;    /* linear light, after exposure, that is shown as white; at least 1 */
	int rounds;     /* 1: codes are rounded, as GL does; 0: dithered */
};

struct display;

/** @return 0 or ERR_SYSTEM (reported) */
int display_create(const struct display_options *options, struct display **out);
void display_destroy(struct display **display);

/**
 * Codes of three channels.
 * @param img    its attribute relume:encoding says whether they are linear
 * @param layer  "" for R, G, B; "gl." for gl.R, gl.G, gl.B
 * @param rgb    [height][width][3]
 * @param over   NULL, or receives how many pixels have a channel brighter than white
 * @return 0, or ERR_INPUT: there are no such channels (reported)
 */
int display_codes(const struct display *display, const struct image *img, const char *layer, uint8_t *rgb,
                  uint64_t *over);

/** Write codes as a file that appears whole. @return 0 or ERR_SYSTEM (reported) */
int display_save(const struct oiio_pixels *pixels, const struct oiio_coding *coding, const char *path);

/**
 * Write R, G, B as a display picture; the file appears whole. Its description holds the picture's frame, trace,
 * settings, version and device, a line each, as oiio_read finds them. The same picture gives the same bytes.
 * @param path  ends in .png, .jpg or .jpeg
 * @param over  as display_codes
 * @return 0 or ERR_SYSTEM (reported)
 */
int display_write(const struct display *display, const struct image *img, const char *path, uint64_t *over);
