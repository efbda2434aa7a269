/*
 * Foreign images: the one bridge to OpenImageIO, which has no C interface. Nothing else includes its headers.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

#include "tracer/image/image.h"

/**
 * fork(), while no thread is within OpenImageIO: the child may use it.
 * @return as fork(); -1 (reported) also where it cannot be loaded
 */
pid_t oiio_fork(void);

/**
 * Read any image OpenImageIO knows, in this process (foreign.h does it in one of its own): first level, data window
 * only (place.h tells where it lies). OpenEXR gives all its parts, each with its data where they lie, each part's name
 * as the layer of its channels, and its unsigned integers as they are; other formats give their first picture.
 *
 * @param img  empty; filled on success: channels R G B and A where there are any, others by their own names; a grey
 *             picture gives R, G and B alike. Integer formats come as numbers in [0,1] with attribute relume:encoding =
 *             "display"; half and float formats as they are, "linear". Colours that are not multiplied by alpha have
 *             attribute relume:alpha = "straight". A description as display_write leaves it gives the attributes in it.
 *             Names longer than image.h's limit are an error, as are pictures above 2^28 pixels.
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int oiio_read(struct image *img, const char *path);

/* A picture for people: display codes. */
struct oiio_pixels {
	uint8_t *rgb; /* [height][width][3], top row first */
	uint32_t width, height;
};

struct oiio_coding {
	const char *format; /* "png" or "jpg" */
	int level;          /* of PNG: zlib's, 1 (fast) .. 9 */
	int quality;        /* of JPEG: 1 .. 100 */
	const char *text;   /* kept as the picture's description; NULL: none */
};

/**
 * Encode pixels as a file in memory. The same pixels give the same bytes.
 * @param out  receives a buffer; caller frees with free()
 * @return 0 or ERR_SYSTEM (reported)
 */
int oiio_encode(const struct oiio_pixels *pixels, const struct oiio_coding *coding, uint8_t **out, size_t *out_bytes);

/**
 * Yee's perceptual metric (compare_Yee, as idiff -p), on codes: how many pixels look different.
 * @param count  receives the number
 * @return 0 or ERR_SYSTEM (reported)
 */
int oiio_compare_yee(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, double *count);

struct oiio_label {
	const char *text;
	int x, y;      /* left end of the base line, from the top left corner */
	int size;      /* height of the letters in pixels */
	uint8_t rgb[3];
};

/**
 * Draw text into pixels; what falls outside is cut.
 * @return 0, or ERR_SYSTEM where no font is installed (not reported: the caller decides whether labels matter)
 */
int oiio_draw_text(const struct oiio_pixels *pixels, const struct oiio_label *label);

#ifdef __cplusplus
}
#endif
