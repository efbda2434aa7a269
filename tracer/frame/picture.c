#include "tracer/frame/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "kernels/gl/pixel.h"

/* Pixels as a picture has them; NULL: not known. */
static void start_pixels(const struct job *job, const struct scene_picture *start, struct frame_pixel *pixels)
{
	uint32_t depth_bits = pixel_depth_bits(job->bits), far = pixel_bits_mask(depth_bits);

	memset(pixels, 0, job->n_pixels * sizeof(*pixels));
	for (uint32_t i = 0; i < job->n_pixels; i++) {
		struct frame_pixel *p = &pixels[i];

		p->surface.order = SCENE_NONE;
		p->unknown = start ? PIXEL_BEFORE : PIXEL_UNKNOWN_COLOR | PIXEL_UNKNOWN_DEPTH | PIXEL_UNKNOWN_STENCIL;
		for (int c = 0; c < 4 && start; c++)
			p->gl[c] = start->colors ? start->colors[4 * (size_t)i + (size_t)c] : (float)start->rgba[4 * (size_t)i + (size_t)c] / 255.0f;
		memcpy(p->shadowed, p->gl, sizeof(p->shadowed));
		memcpy(p->direct, p->gl, sizeof(p->direct));
		memcpy(p->mirrored, p->gl, sizeof(p->mirrored));
		memcpy(p->beauty, p->gl, sizeof(p->beauty));
		p->depth = !start ? far : depth_bits > 24 ? start->depth[i] << 8 | start->depth[i] >> 16 : start->depth[i];
		p->depth_exact = far ? (float)p->depth / (float)far : 1;
		p->stencil = start ? start->stencil[i] : 0;
	}
}

int picture_upload_start(struct job *job)
{
	const struct scene_picture *start = job->scene->start;
	struct frame_pixel *pixels = malloc(job->n_pixels * sizeof(*pixels));
	int err = 0;

	if (!pixels)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", job->width, job->height);
	for (uint32_t i = 0; i < job->n_samples && !err; i++) {
		if (i == 0 || (start && start->samples))
			start_pixels(job, start && start->samples && job->n_samples > 1 ? &start->samples[i] : start, pixels);
		err = device_write(job->tr->dev, frame_sample(job, i)->buffer, 0, pixels, job->n_pixels * sizeof(*pixels));
	}
	free(pixels);
	return err;
}

/* Pixels of the frame on the device, or of one of their samples, rounded as GL's frame buffer is. */
static int read_pixels(struct tracer *tr, union buffer_frame_pixel from, const struct scene *scene, struct frame_pixel *pixels,
                       struct scene_picture *picture)
{
	size_t n = (size_t)scene->width * scene->height;
	int err = device_read(tr->dev, from.buffer, 0, pixels, n * sizeof(*pixels));

	picture->unknown = 0;
	for (size_t i = 0; i < n && !err; i++) {
		for (int c = 0; c < 4; c++)
			picture->rgba[4 * i + (size_t)c] = (uint8_t)rintf(clamp01(pixels[i].gl[c]) * 255.0f);
		if (picture->colors)
			memcpy(picture->colors + 4 * i, pixels[i].gl, sizeof(pixels[i].gl));
		if (!scene->alpha_bits)
			picture->rgba[4 * i + 3] = 255;
		if (!scene->alpha_bits && picture->colors)
			picture->colors[4 * i + 3] = 1;
		picture->depth[i] = scene->depth_bits > 24 ? pixels[i].depth >> 8 : pixels[i].depth; /* pictures have 24 at most */
		picture->stencil[i] = (uint8_t)pixels[i].stencil;
		picture->unknown += (pixels[i].unknown & (PIXEL_UNKNOWN_COLOR | PIXEL_UNKNOWN_TEST)) != 0;
	}
	return err;
}

int picture_read(struct tracer *tr, const struct scene *scene, struct scene_picture *picture)
{
	struct frame_pixel *pixels = malloc((size_t)scene->width * scene->height * sizeof(*pixels));
	int err;

	if (!pixels)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", scene->width, scene->height);
	err = read_pixels(tr, tr->buffers.frame, scene, pixels, picture);
	for (uint32_t i = 0; i < SCENE_SAMPLES && picture->samples && scene->samples > 1 && !err; i++)
		err = read_pixels(tr, tr->buffers.samples[i], scene, pixels, &picture->samples[i]);
	free(pixels);
	return err;
}
