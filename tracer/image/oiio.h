/*
 * The only bridge to OpenImageIO, which has no C interface. No other file includes its headers.
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
 * Call fork() while no thread is in OpenImageIO, so that the child may use it.
 * @return as fork(); -1 (reported) also if OpenImageIO cannot be loaded
 */
pid_t oiio_fork(void);

/**
 * Read any image that OpenImageIO supports, in this process (foreign.h uses a separate one). Reads the first level, and
 * only the data window (place.h has its position). An OpenEXR file gives all its parts, each at the position of its
 * data window and with its name as the layer of its channels; its unsigned integers are unchanged. Other formats give
 * their first picture.
 *
 * @param img  empty; filled on success: channels R, G, B and A if present, others by their own names; a grey picture
 *             gives equal R, G and B. Integer formats come as numbers in [0,1] with attribute relume:encoding =
 *             "display"; half and float formats as they are, "linear". Colours that are not multiplied by alpha have
 *             attribute relume:alpha = "straight". A description written by display_write gives the attributes in it.
 *             Names longer than image.h's limit are an error, as are pictures above 2^28 pixels.
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int oiio_read(struct image *img, const char *path);

/* A picture as display codes. */
struct oiio_pixels {
	uint8_t *rgb; /* [height][width][3], top row first */
	uint32_t width, height;
};

struct oiio_coding {
	const char *format; /* "png" or "jpg" */
	int level;          /* for PNG: zlib's level, 1 (fast) .. 9 */
	int quality;        /* for JPEG: 1 .. 100 */
	const char *text;   /* stored as the picture's description; NULL: none */
};

/**
 * Encode pixels as a file in memory. The same pixels give the same bytes.
 * @param out  receives a buffer; free with free()
 * @return 0 or ERR_SYSTEM (reported)
 */
int oiio_encode(const struct oiio_pixels *pixels, const struct oiio_coding *coding, uint8_t **out, size_t *out_bytes);

/**
 * Yee's perceptual metric (compare_Yee, as idiff -p), on codes: counts the pixels that look different.
 * @param count  receives the number
 * @return 0 or ERR_SYSTEM (reported)
 */
int oiio_compare_yee(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, double *count);

struct oiio_label {
	const char *text;
	int x, y;      /* left end of the baseline, relative to the top left corner */
	int size;      /* height of the letters in pixels */
	uint8_t rgb[3];
};

/**
 * Draw text into pixels, clipped at their edges.
 * @return 0, or ERR_SYSTEM if no font is installed (not reported: the caller decides whether labels matter)
 */
int oiio_draw_text(const struct oiio_pixels *pixels, const struct oiio_label *label);

#ifdef __cplusplus
}
#endif
