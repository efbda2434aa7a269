#include "tracer/frame/picture/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "kernels/frame/plain/plain.h"
#include "kernels/gl/pixel.h"
#include "tracer/frame/picture/buffers.h"

/* Copy the band's pixels from a picture; NULL: unknown. */
static void start_pixels(const struct band *band, const struct scene_picture *start, struct frame_pixel *pixels)
{
	memset(pixels, 0, band->n_pixels * sizeof(*pixels));
	for (uint32_t k = 0; k < band->n_pixels; k++) {
		struct frame_pixel *p = &pixels[k];
		const size_t i = frame_first_pixel(band) + (size_t)k;
		float gl[4] = { 0 };

		for (int c = 0; c < 4 && start; c++)
			gl[c] = start->colors ? start->colors[4 * i + (size_t)c] :
			                        (float)start->rgba[4 * i + (size_t)c] / 255.0f;
		pixel_start(p, gl, start ? start->depth[i] : 0, band->frame->bits);
		p->stencil = start ? start->stencil[i] : 0;
		if (!start)
			p->unknown = PIXEL_UNKNOWN_COLOR | PIXEL_UNKNOWN_DEPTH | PIXEL_UNKNOWN_STENCIL;
	}
}

int picture_upload_start(const struct band *band)
{
	const struct frame *frame = band->frame;
	const struct scene_picture *start = frame->scene->start;
	struct frame_pixel *pixels = malloc(band->n_pixels * sizeof(*pixels));
	int err = 0;

	if (!pixels)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", frame->width, frame->height);
	for (uint32_t i = 0; i < band->pass->n_samples && !err; i++) {
		if (i == 0 || (start && start->samples))
			start_pixels(band,
			             start && start->samples && band->pass->n_samples > 1 ? &start->samples[i] : start,
			             pixels);
		err = device_write(frame->tr->dev, frame_sample(band->pass, i)->buffer, 0, pixels,
		                   band->n_pixels * sizeof(*pixels));
	}
	free(pixels);
	return err;
}

/* Read the band's pixels, or those of one sample, from the device, rounded to GL's frame buffer. */
static int read_pixels(const struct band *band, union buffer_frame_pixel from, struct frame_pixel *pixels,
                       struct scene_picture *picture)
{
	const struct scene *scene = band->frame->scene;
	int err = device_read(band->frame->tr->dev, from.buffer, 0, pixels, band->n_pixels * sizeof(*pixels));

	for (uint32_t k = 0; k < band->n_pixels && !err; k++) {
		const struct frame_pixel *p = &pixels[k];
		const size_t i = frame_first_pixel(band) + (size_t)k;

		for (int c = 0; c < 4; c++)
			picture->rgba[4 * i + (size_t)c] = (uint8_t)rintf(clamp01(p->gl[c]) * 255.0f);
		if (picture->colors)
			memcpy(picture->colors + 4 * i, p->gl, sizeof(p->gl));
		if (!scene->alpha_bits)
			picture->rgba[4 * i + 3] = 255;
		if (!scene->alpha_bits && picture->colors)
			picture->colors[4 * i + 3] = 1;
		picture->depth[i] = scene->depth_bits > 24 ? p->depth >> 8 : p->depth; /* at most 24 in pictures */
		picture->stencil[i] = (uint8_t)p->stencil;
	}
	return err;
}

int picture_read_band(const struct band *band, struct scene_picture *picture)
{
	const struct frame *frame = band->frame;
	struct frame_pixel *pixels = malloc(band->n_pixels * sizeof(*pixels));
	int err;

	if (!pixels)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u pixels", band->n_pixels);
	err = read_pixels(band, frame->tr->pixels.frame, pixels, picture);
	for (uint32_t i = 0; i < SCENE_SAMPLES && picture->samples && frame->scene->samples > 1 && !err; i++)
		err = read_pixels(band, frame->tr->pixels.samples[i], pixels, &picture->samples[i]);
	free(pixels);
	return err;
}

/* Read a plane of the band with one word per pixel. */
static int take_words(const struct band *band, const struct device_buffer *buffer, void *out)
{
	return device_read(band->frame->tr->dev, buffer, 0, out, band->n_pixels * sizeof(uint32_t));
}

int picture_count_rows(const struct band *band, union buffer_uint unknown)
{
	const struct frame *frame = band->frame;
	const uint32_t n = plain_columns(frame->width) * band->n_rows;
	const void *mapped;
	int err = device_map(frame->tr->dev, unknown.buffer, n * sizeof(uint32_t), 1, &mapped);

	if (err)
		return err;
	for (uint32_t i = 0; i < n; i++)
		band->pass->drawn->unknown += (uint32_t)__builtin_popcount(((const uint32_t *)mapped)[i]);
	return device_unmap(frame->tr->dev, unknown.buffer, mapped);
}

static int is_unknown(const struct frame_pixel *p)
{
	return (p->unknown & (PIXEL_UNKNOWN_COLOR | PIXEL_UNKNOWN_TEST)) != 0;
}

int picture_count_band(const struct band *band)
{
	const struct frame *frame = band->frame;
	const struct frame_pixel *pixels;
	const void *mapped;
	int err = device_map(frame->tr->dev, frame->tr->pixels.frame.buffer, band->n_pixels * sizeof(*pixels), 1,
	                     &mapped);

	if (err)
		return err;
	pixels = mapped;
	for (uint32_t i = 0; i < band->n_pixels; i++)
		band->pass->drawn->unknown += (uint32_t)is_unknown(&pixels[i]);
	return device_unmap(frame->tr->dev, frame->tr->pixels.frame.buffer, mapped);
}

int picture_take_band(const struct band *band, union buffer_float kept, union buffer_uint unknown, uint32_t stencil)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	struct picture_buffers *b = tr->picture;
	const struct scene *scene = frame->scene;
	const size_t first = frame_first_pixel(band);
	const uint32_t rows = plain_columns(frame->width) * band->n_rows;
	int err = launch_reserve(tr->dev, b->colors, band->n_pixels);

	if (!err)
		err = launch_reserve(tr->dev, b->depths, band->n_pixels);
	if (!err)
		err = launch_layered_picture(tr->dev, rows,
		                             LAUNCH(layered_picture, .kept = kept, .width = frame->width,
		                                    .height = band->n_rows, .bits = frame->bits, .colors = b->colors,
		                                    .depths = b->depths, .unknown = unknown));
	if (!err)
		err = take_words(band, b->colors.buffer, band->pass->picture->rgba + 4 * first);
	if (!err)
		err = take_words(band, b->depths.buffer, band->pass->picture->depth + first);
	if (!err)
		err = picture_count_rows(band, unknown);
	if (scene->start)
		memcpy(band->pass->picture->stencil + first, scene->start->stencil + first, band->n_pixels);
	else
		memset(band->pass->picture->stencil + first,
		       (int)(stencil & pixel_bits_mask(pixel_stencil_bits(frame->bits))), band->n_pixels);
	return err;
}

int picture_keep_start(const struct band *band, union buffer_float kept)
{
	const struct frame *frame = band->frame;
	const struct scene_picture *start = frame->scene->start;
	struct device *dev = frame->tr->dev;
	struct picture_buffers *b = frame->tr->picture;
	const size_t first = frame_first_pixel(band);
	int err = launch_reserve(dev, b->colors, band->n_pixels);

	if (!err)
		err = device_write(dev, b->colors.buffer, 0, start->rgba + 4 * first,
		                   band->n_pixels * sizeof(uint32_t));
	if (!err)
		err = launch_upload(dev, b->depths, start->depth + first, band->n_pixels);
	return err ? err :
	             launch_layered_start(dev, (size_t)plain_columns(frame->width) * band->n_rows,
	                                  LAUNCH(layered_start, .colors = b->colors, .depths = b->depths,
	                                         .width = frame->width, .height = band->n_rows, .bits = frame->bits,
	                                         .kept = kept));
}
