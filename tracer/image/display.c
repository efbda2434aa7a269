#include "tracer/image/display.h"

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <half.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/err.h"
#include "base/half.h"
#include "base/part.h"
#include "tracer/image/oiio.h"

#define KNEE 0.6f
#define N_HALVES 65536u
#define PNG_LEVEL 6
#define JPEG_QUALITY 95

/* The code of every half float before dithering, by its bits: as linear light, and as a display-referred value. */
struct display {
	float linear[N_HALVES], shown[N_HALVES];
	float white;  /* linear light, before exposure, that is shown as white */
	float dither; /* width of the dither's range, in codes; 0: off */
};

enum display_kind display_kind_of(const char *path)
{
	static const struct { const char *ending; enum display_kind kind; } known[] = {
		{ ".exr", DISPLAY_EXR }, { ".png", DISPLAY_PNG }, { ".jpg", DISPLAY_JPEG }, { ".jpeg", DISPLAY_JPEG },
	};
	const size_t n = strlen(path);

	for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); i++) {
		const size_t m = strlen(known[i].ending);

		if (n > m && path[n - m - 1] != '/' && strcasecmp(path + n - m, known[i].ending) == 0)
			return known[i].kind;
	}
	return DISPLAY_NONE;
}

int display_refuse(const char *path)
{
	const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;

	if (name[0] == '.' && !strchr(name + 1, '.'))
		return err_report(ERR_USAGE, NULL, "'%s' names no file before its ending; write %.*s####%s", path,
		                  (int)(name - path), path, name);
	return err_report(
		ERR_USAGE, NULL,
		"'%s' names no kind of picture: end it in .exr (OpenEXR, all channels), .png or .jpg (display "
		"pictures)",
		path);
}

/* --- The curve --------------------------------------------------------------------------------------------------- */

/* The code of a linear value before dithering: the formula of display.h. */
static float code_of(const struct display_options *options, float linear)
{
	const float white = options->white, m = (white - KNEE) / (1 - KNEE);
	float y = linear * exp2f(options->exposure), t;

	if (!(y > 0)) /* NaN becomes black */
		return 0;
	t = (y - KNEE) / (white - KNEE);
	if (t >= 1)
		return 255;
	if (t > 0 && white > 1)
		y = KNEE + (1 - KNEE) * m * t / (1 + (m - 1) * t);
	return 255 * image_display_from_linear(y);
}

int display_create(const struct display_options *options, struct display **out)
{
	struct display *d = *out = malloc(sizeof(*d));

	if (!d)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	d->dither = options->rounds ? 0 : 0.9f;
	d->white = options->white / exp2f(options->exposure);
	for (uint32_t h = 0; h < N_HALVES; h++) {
		const float value = half_to_float((uint16_t)h);

		d->linear[h] = code_of(options, value);
		d->shown[h] = code_of(options, image_linear_from_display(value));
	}
	return 0;
}

void display_destroy(struct display **display)
{
	free(*display);
	*display = NULL;
}

/* --- Codes ------------------------------------------------------------------------------------------------------- */

/* Bayer's 8 x 8 matrix: the bits of x ^ y and of y, interleaved in reverse order. In 0 .. 63 */
static uint32_t bayer(uint32_t x, uint32_t y)
{
	uint32_t place = 0;

	for (uint32_t bit = 0; bit < 3; bit++)
		place = place << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
	return place;
}

int display_codes(const struct display *display, const struct image *img, const char *layer, uint8_t *rgb,
                  uint64_t *over)
{
	const char *encoding = image_attribute(img, "relume:encoding");
	const int is_shown = encoding && strcmp(encoding, "display") == 0;
	const float *const codes = is_shown ? display->shown : display->linear;
	const float white = is_shown ? image_display_from_linear(display->white) : display->white;
	const float *planes[3];
	uint64_t bright = 0;

	for (int c = 0; c < 3; c++) {
		char name[32];

		snprintf(name, sizeof(name), "%s%c", layer, "RGB"[c]);
		planes[c] = image_channel(img, name);
		if (!planes[c])
			return err_report(ERR_INPUT, NULL, "the picture has no channel %s", name);
	}
	for (uint32_t y = 0; y < img->height; y++) {
		for (uint32_t x = 0; x < img->width; x++) {
			const size_t at = (size_t)y * img->width + x;
			const float dither = 0.5f + display->dither * (((float)bayer(x & 7, y & 7) + 0.5f) / 64 - 0.5f);

			for (int c = 0; c < 3; c++)
				rgb[3 * at + (size_t)c] = (uint8_t)(codes[imath_float_to_half(planes[c][at])] + dither);
			bright += planes[0][at] > white || planes[1][at] > white || planes[2][at] > white;
		}
	}
	if (over)
		*over = bright;
	return 0;
}

/* --- Files ------------------------------------------------------------------------------------------------------- */

/* The picture's description: one line for each attribute it has, "NAME TEXT". */
static void describe(const struct image *img, char *text, size_t size)
{
	static const char *const names[] = { "relume:frame",    "relume:trace",   "relume:program",
		                             "relume:settings", "relume:version",  "relume:device",
		                             "relume:moment" };
	size_t n = 0;

	text[0] = '\0';
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
		const char *value = image_attribute(img, names[i]);

		if (value && n < size)
			n += (size_t)snprintf(text + n, size - n, "%s %s\n", names[i], value);
	}
}

int display_save(const struct oiio_pixels *pixels, const struct oiio_coding *coding, const char *path)
{
	struct part_file file;
	uint8_t *bytes = NULL;
	size_t n_bytes = 0;
	int err = oiio_encode(pixels, coding, &bytes, &n_bytes);

	if (!err)
		err = part_open(&file, path);
	if (!err) {
		fwrite(bytes, 1, n_bytes, file.stream); /* part_close checks for failure */
		err = part_close(&file, 0);
	}
	free(bytes);
	return err;
}

int display_write(const struct display *display, const struct image *img, const char *path, uint64_t *over)
{
	char text[2048];
	struct oiio_pixels pixels = { malloc((size_t)img->width * img->height * 3), img->width, img->height };
	const struct oiio_coding coding = { display_kind_of(path) == DISPLAY_PNG ? "png" : "jpg", PNG_LEVEL,
		                            JPEG_QUALITY, text };
	int err = pixels.rgb ? display_codes(display, img, "", pixels.rgb, over) :
	                       err_report(ERR_SYSTEM, NULL, "out of memory");

	describe(img, text, sizeof(text));
	if (!err)
		err = display_save(&pixels, &coding, path);
	free(pixels.rgb);
	return err;
}
