/*
 * Noise out of rendered frames, by what is known without noise: albedo, normals, depth, motion vectors.
 *
 * What lights the surfaces (beauty less reflect and refract, over albedo) and what mirrors and glass show are filtered apart. Over
 * time: a point's light in frames before and after, followed by motion vectors, where surface and brightness are the same. Then over the
 * picture: five passes of an a-trous wavelet whose steps double (H. Dammertz et al., "Edge-Avoiding A-Trous Wavelet Transform for fast
 * Global Illumination Filtering", 2010), guided by normals, depth and the variance that is left (C. Schied et al., "Spatiotemporal
 * Variance-Guided Filtering", 2017), which neighbours tell
 * (filter_guess.h). All in C on this processor: the same frames give the same bytes, whatever the number of threads.
 */
#pragma once

#include "tracer/image/image.h"

/* The groups of channels that filter_take needs beside the beauty, as `relume render --aov` takes them. */
#define FILTER_NEEDS "reflect,refract,albedo,N,Z"

struct filter_frame {
	uint32_t width, height;
	float (*light)[3], (*gloss)[3]; /* on surfaces; in mirrors and through glass */
	float *variance;                /* of light's noise, the mean of the channels */
	float *guess;                   /* brightness as it may be, to compare frames by */
	float (*albedo)[3], (*normal)[3], *depth;
	float (*motion)[3]; /* pixels right and down since the frame before, and 1 where that is known */
	uint8_t *is_there;  /* 1: a surface */
	uint8_t *is_inner;  /* 1: and so are the pixels about it, the same: none of its samples lie elsewhere */
};

/**
 * Take apart what a file holds.
 * @param where  its name, for messages
 * @param out    all zero; filter_free
 * @return 0; ERR_INPUT (reported: channels are missing); ERR_SYSTEM (reported)
 */
int filter_take(struct image *img, const char *where, struct filter_frame *out);
void filter_free(struct filter_frame *frame);

/** Estimate variance and guess; filter_time and filter_space ask for it. @return 0 or ERR_SYSTEM (reported) */
int filter_guess(struct filter_frame *frame);

/**
 * Mix in the same points of other frames.
 * @param frames  [n] in order, one a frame, sizes alike, guessed; of all but frames[middle] light and gloss are read as they were taken
 * @param out     of frames[middle]: receives light, gloss and variance
 */
int filter_time(const struct filter_frame *const *frames, unsigned n, unsigned middle, struct filter_frame *out);

/** Over the picture. @return 0 or ERR_SYSTEM (reported) */
int filter_space(struct filter_frame *frame);

/**
 * The planes of R, G and B, to be written; effect channels, which will no longer add up to them, go.
 * @return 0 or ERR_SYSTEM (reported)
 */
int filter_beauty(struct image *img, float *to[3]);

/** Into R, G and B, as filter_beauty. @return 0 or ERR_SYSTEM (reported) */
int filter_put(const struct filter_frame *frame, struct image *img);

/**
 * All of this for a frame by itself.
 * @return 0; ERR_INPUT (reported: channels are missing); ERR_SYSTEM (reported)
 */
int filter_alone(struct image *img);
