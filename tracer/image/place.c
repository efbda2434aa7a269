#include "tracer/image/place.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define MAX_PIXELS ((uint64_t)1 << 28)

/* Overlap of two windows along one axis: start in the picture, start in the data, and length. */
struct span {
	uint32_t from, at, n;
};

static struct span overlap(int64_t first, uint32_t n_data, uint32_t n)
{
	const int64_t low = first > 0 ? first : 0, high = first + n_data < n ? first + n_data : n;

	return high > low ? (struct span){ (uint32_t)low, (uint32_t)(low - first), (uint32_t)(high - low) } :
	                    (struct span){ 0 };
}

/* Copy the overlap and the attributes into a picture of the display window. @return 0 or ERR_SYSTEM (reported) */
static int fill(const struct image *img, struct span x, struct span y, struct image *out)
{
	for (size_t c = 0; c < img->n_channels; c++) {
		const float *from = image_values(img, c);
		float *to = image_add_channel(out, img->channels[c].name, img->channels[c].full_float);

		if (!from || !to)
			return ERR_SYSTEM;
		for (uint32_t row = 0; row < y.n; row++)
			memcpy(to + (size_t)(y.from + row) * out->width + x.from, from + (size_t)(y.at + row) * img->width + x.at,
			       x.n * sizeof(*to));
	}
	for (size_t i = 0; i < img->n_attributes; i++)
		if (image_set_attribute(out, img->attributes[i].name, "%s", img->attributes[i].text))
			return ERR_SYSTEM;
	if (x.n == out->width && y.n == out->height)
		return 0;
	out->outside = malloc((size_t)out->width * out->height);
	if (!out->outside)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	memset(out->outside, 1, (size_t)out->width * out->height);
	for (uint32_t row = 0; row < y.n; row++)
		memset(out->outside + (size_t)(y.from + row) * out->width + x.from, 0, x.n);
	return 0;
}

int image_place(struct image *img, const char *path)
{
	const char *text = image_attribute(img, "relume:window");
	struct image out = { 0 };
	long long first[2];
	struct span x, y;
	int err;

	if (!text || sscanf(text, "%lld %lld %u %u", &first[0], &first[1], &out.width, &out.height) != 4)
		return 0;
	x = overlap(first[0], img->width, out.width);
	y = overlap(first[1], img->height, out.height);
	if ((uint64_t)out.width * out.height > MAX_PIXELS)
		return err_report(ERR_INPUT, path, "its display window (%u x %u) has more than %llu pixels", out.width,
		                  out.height, (unsigned long long)MAX_PIXELS);
	if (!x.n || !y.n)
		return err_report(
			ERR_INPUT, path,
			"its data window (%u x %u at %lld, %lld) shows nothing of its display window (%u x %u)",
			img->width, img->height, first[0], first[1], out.width, out.height);
	err = fill(img, x, y, &out);
	if (err) {
		image_free(&out);
		return err;
	}
	image_free(img);
	*img = out;
	return 0;
}
