#include "tracer/image.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

void image_free(struct image *img)
{
	for (size_t i = 0; i < img->n_channels; i++)
		free(img->channels[i].values);
	free(img->channels);
	free(img->attributes);
	memset(img, 0, sizeof(*img));
}

float *image_add_channel(struct image *img, const char *name, int full_float)
{
	struct image_channel *channels, *channel;
	size_t n_pixels = (size_t)img->width * img->height;

	channels = realloc(img->channels, (img->n_channels + 1) * sizeof(*channels));
	if (!channels)
		goto fail;
	img->channels = channels;
	channel = &channels[img->n_channels];
	memset(channel, 0, sizeof(*channel));
	snprintf(channel->name, sizeof(channel->name), "%s", name);
	channel->full_float = full_float;
	channel->values = calloc(n_pixels ? n_pixels : 1, sizeof(float));
	if (!channel->values)
		goto fail;
	img->n_channels++;
	return channel->values;
fail:
	err_report(ERR_SYSTEM, NULL, "out of memory for channel %s of %u x %u pixels", name, img->width, img->height);
	return NULL;
}

float *image_channel(const struct image *img, const char *name)
{
	for (size_t i = 0; i < img->n_channels; i++)
		if (strcmp(img->channels[i].name, name) == 0)
			return img->channels[i].values;
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

	if (!attribute) {
		attribute = realloc(img->attributes, (img->n_attributes + 1) * sizeof(*attribute));
		if (!attribute)
			return err_report(ERR_SYSTEM, NULL, "out of memory for attribute %s", name);
		img->attributes = attribute;
		attribute += img->n_attributes++;
		snprintf(attribute->name, sizeof(attribute->name), "%s", name);
	}
	va_start(args, fmt);
	vsnprintf(attribute->text, sizeof(attribute->text), fmt, args);
	va_end(args);
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
