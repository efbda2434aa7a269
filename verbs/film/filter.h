/*
 * Removes noise from rendered frames, guided by channels without noise: albedo, normals, depth, motion vectors.
 *
 * The light on surfaces ((beauty - reflect - refract) / albedo) and the light from mirrors and glass are filtered
 * separately. First over time: points are followed along motion vectors into frames before and after, and their light
 * there is mixed in wherever surface and brightness are the same. Then over the picture: five passes of an a-trous
 * wavelet whose steps double (H. Dammertz et al., "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination
 * Filtering", 2010), guided by normals, depth and the remaining variance (C. Schied et al., "Spatiotemporal
 * Variance-Guided Filtering", 2017), which is estimated from neighbours (filter_guess.h). All in C on this processor:
 * the same frames give the same bytes with any number of threads.
 */
#pragma once

#include "tracer/image/image.h"

/* The groups of channels that filter_take needs beside the beauty, as `relume render --aov` takes them. */
#define FILTER_NEEDS "reflect,refract,albedo,N,Z"

struct filter_frame {
	uint32_t width, height;
	float (*light)[3], (*gloss)[3]; /* on surfaces; in mirrors and through glass */
	float *variance;                /* variance of light's noise, mean of the channels */
	float *guess;                   /* estimated brightness without noise, to compare frames by */
	float (*albedo)[3], (*normal)[3], *depth;
	float (*motion)[3]; /* pixels right and down since the previous frame, and 1 if these are known */
	uint8_t *is_there;  /* 1: a surface */
	uint8_t *is_inner;  /* 1: the pixels around it are the same surface, so all its samples are on it */
};

/**
 * Split a frame's picture into what the filter needs.
 * @param where  its name, for messages
 * @param out    all zero; filter_free
 * @return 0; ERR_INPUT (reported: channels are missing); ERR_SYSTEM (reported)
 */
int filter_take(struct image *img, const char *where, struct filter_frame *out);
void filter_free(struct filter_frame *frame);

/** Estimate variance and guess; call before filter_time and filter_space. @return 0 or ERR_SYSTEM (reported) */
int filter_guess(struct filter_frame *frame);

/**
 * Mix the same points of other frames into a frame.
 * @param frames  [n] in order, all of one size, after filter_guess; light and gloss are as filter_take left them, but
 *                for frames[middle]
 * @param out     receives light, gloss and variance of frames[middle]
 */
int filter_time(const struct filter_frame *const *frames, unsigned n, unsigned middle, struct filter_frame *out);

/** Filter over the picture. @return 0 or ERR_SYSTEM (reported) */
int filter_space(struct filter_frame *frame);

/**
 * Get the planes of R, G and B, to overwrite them. Effect channels are removed, as they will no longer add up to these.
 * @return 0 or ERR_SYSTEM (reported)
 */
int filter_beauty(struct image *img, float *to[3]);

/** Write the result into R, G and B, as filter_beauty. @return 0 or ERR_SYSTEM (reported) */
int filter_put(const struct filter_frame *frame, struct image *img);

/**
 * Denoise a single frame: all steps above except filter_time.
 * @return 0; ERR_INPUT (reported: channels are missing); ERR_SYSTEM (reported)
 */
int filter_alone(struct image *img);
