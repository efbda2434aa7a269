#include "tracer/image/image.h"

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <half.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "tracer/image/pack.h"

static void free_planes(struct image_channel *channel)
{
	free(channel->values);
	free(channel->halves);
	channel->values = NULL;
	channel->halves = NULL;
}

void image_free(struct image *img)
{
	for (size_t i = 0; i < img->n_channels; i++)
		free_planes(&img->channels[i]);
	pack_destroy(&img->pack);
	free(img->channels);
	for (size_t i = 0; i < img->n_attributes; i++)
		free(img->attributes[i].text);
	free(img->attributes);
	free(img->outside);
	memset(img, 0, sizeof(*img));
}

/* Report it. @return NULL, for functions that return a plane */
static void *no_memory(const struct image *img, const char *name)
{
	err_report(ERR_SYSTEM, NULL, "out of memory for channel %s of %u x %u pixels", name, img->width, img->height);
	return NULL;
}

/* Number of pixels that a plane has room for: one chunk's if rows are packed as they arrive. At least 1. */
static size_t pixel_count(const struct image *img)
{
	size_t n = (size_t)img->width * (img->packers ? PACK_ROWS : img->height);

	return n ? n : 1;
}

/* Make room for another channel, without a plane. The caller raises n_channels once it has allocated the plane. */
static struct image_channel *next_channel(struct image *img, const char *name, int full_float)
{
	struct image_channel *channel;

	if (memory_resize(&img->channels, img->n_channels + 1, sizeof(*channel)))
		return NULL;
	channel = &img->channels[img->n_channels];
	memset(channel, 0, sizeof(*channel));
	snprintf(channel->name, sizeof(channel->name), "%s", name);
	channel->full_float = full_float;
	return channel;
}

float *image_add_channel(struct image *img, const char *name, int full_float)
{
	struct image_channel *channel = next_channel(img, name, full_float);

	if (!channel)
		return NULL;
	channel->values = calloc(pixel_count(img), sizeof(*channel->values));
	if (!channel->values)
		return no_memory(img, name);
	img->n_channels++;
	return channel->values;
}

uint16_t *image_add_halves(struct image *img, const char *name)
{
	struct image_channel *channel = next_channel(img, name, 0);

	if (!channel)
		return NULL;
	channel->halves = malloc(pixel_count(img) * sizeof(*channel->halves));
	if (!channel->halves)
		return no_memory(img, name);
	img->n_channels++;
	return channel->halves;
}

static size_t row_bytes(const struct image *img, size_t i)
{
	return img->width * (img->channels[i].halves ? sizeof(uint16_t) : sizeof(float));
}

/* Copy rows skip .. skip + n - 1 of the given planes to rows at .. at + n - 1 of the image's own. */
static void keep_rows(struct image *img, const void *const *planes, uint32_t skip, uint32_t n, uint32_t at)
{
	for (size_t i = 0; i < img->n_channels && n; i++) {
		const struct image_channel *channel = &img->channels[i];
		char *own = channel->halves ? (char *)channel->halves : (char *)channel->values;
		const size_t bytes = row_bytes(img, i);

		memcpy(own + at * bytes, (const char *)planes[i] + skip * bytes, n * bytes);
	}
}

/*
 * Pack the next n rows. Between calls, the image's planes hold the rows of the chunk that is not complete yet: rows
 * img->first .. img->taken - 1, fewer than PACK_ROWS.
 */
static int pack_rows(struct image *img, const void *const *planes, uint32_t n)
{
	const uint32_t row = img->taken, end = row + n, waiting = row - img->first;
	const uint32_t missing = waiting ? PACK_ROWS - waiting : 0, head = missing < n ? missing : n;
	int err = 0;

	if (!img->pack)
		err = pack_create(img, img->packers, &img->pack);
	if (err)
		return err;
	/* Fill the chunk that waits in the image's planes, and pack it. */
	keep_rows(img, planes, 0, head, waiting);
	if (head)
		err = pack_until(img->pack, img, NULL, 0, row + head);
	/* Pack whole chunks directly from the caller's planes. */
	if (!err && head < n)
		err = pack_until(img->pack, img, planes, row, end);
	if (err)
		return err;
	/* Keep the rest; if no chunk became complete, rows that joined a waiting chunk are there already. */
	/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference): pack_create has set it */
	if (img->pack->n_packed * PACK_ROWS > img->first) {
		img->first = img->pack->n_packed * PACK_ROWS;
		keep_rows(img, planes, img->first - row, img->first < end ? end - img->first : 0, 0);
	} else if (!waiting) {
		keep_rows(img, planes, 0, n, 0);
	}
	return 0;
}

int image_take_rows(struct image *img, const void *const *planes, uint32_t n)
{
	int err = 0;

	if (img->packers)
		err = pack_rows(img, planes, n);
	else
		keep_rows(img, planes, 0, n, img->taken);
	img->taken += n;
	/* Once all rows are packed, the planes are not needed. */
	for (size_t i = 0; i < img->n_channels && img->packers && img->taken == img->height; i++)
		free_planes(&img->channels[i]);
	return err;
}

float *image_values(const struct image *img, size_t i)
{
	struct image_channel *channel = &img->channels[i];
	size_t n = pixel_count(img);

	if (channel->values || !channel->halves)
		return channel->values;
	channel->values = malloc(n * sizeof(*channel->values));
	if (!channel->values)
		return no_memory(img, channel->name);
	for (size_t k = 0; k < n; k++)
		channel->values[k] = imath_half_to_float(channel->halves[k]);
	return channel->values;
}

float *image_channel(const struct image *img, const char *name)
{
	for (size_t i = 0; i < img->n_channels; i++)
		if (strcmp(img->channels[i].name, name) == 0)
			return image_values(img, i);
	return NULL;
}

static struct image_attribute *find_attribute(const struct image *img, const char *name)
{
	for (size_t i = 0; i < img->n_attributes; i++)
		if (strcmp(img->attributes[i].name, name) == 0)
			return &img->attributes[i];
	return NULL;
}

int image_set_attribute(struct image *img, const char *name, const char *fmt, ...)
{
	struct image_attribute *attribute = find_attribute(img, name);
	va_list args;
	char *text;
	int bytes;

	va_start(args, fmt);
	bytes = vasprintf(&text, fmt, args);
	va_end(args);
	if (bytes < 0)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!attribute) {
		if (memory_resize(&img->attributes, img->n_attributes + 1, sizeof(*attribute))) {
			free(text);
			return ERR_SYSTEM;
		}
		attribute = &img->attributes[img->n_attributes++];
		snprintf(attribute->name, sizeof(attribute->name), "%s", name);
		attribute->text = NULL;
	}
	free(attribute->text);
	attribute->text = text;
	return 0;
}

const char *image_attribute(const struct image *img, const char *name)
{
	const struct image_attribute *attribute = find_attribute(img, name);

	return attribute ? attribute->text : NULL;
}

float image_linear_from_display(float display)
{
	float x = fabsf(display);
	float y = x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);

	return copysignf(y, display);
}

float image_display_from_linear(float linear)
{
	float x = fabsf(linear);
	float y = x <= 0.0031308f ? x * 12.92f : 1.055f * powf(x, 1 / 2.4f) - 0.055f;

	return copysignf(y, linear);
}
