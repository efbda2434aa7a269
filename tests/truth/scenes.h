/* Helpers of the truth tests for scenes built by hand (verbs/render/check/made.h). */
#pragma once

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "verbs/render/check/made.h"
#include "tracer/device/device.h"
#include "tracer/image/image.h"
#include "tracer/frame/trace.h"

/**
 * Give a scene one texture of 2 x 2 texels, two of them nearly transparent, in a unit that modulates.
 * @param unit  the scene's; other members may be set afterwards
 */
static inline void truth_add_texture(struct made *made, struct scene_unit *unit)
{
	static const uint8_t texels[] = { 255, 0, 0, 255, 0, 255, 0, 60, 0, 0, 255, 255, 255, 255, 255, 60 };
	static const struct scene_texture texture = { .hash = { 7, 7 }, .target = GL_TEXTURE_2D, .base_format = GL_RGBA,
		                                      .width = 2, .height = 2, .depth = 1, .n_levels = 1,
		                                      .texels = texels, .n_bytes = sizeof(texels) };
	static const struct scene_texture *const textures[] = { &texture };

	*unit = (struct scene_unit){ .wrap_s = GL_REPEAT, .wrap_t = GL_REPEAT, .wrap_r = GL_REPEAT, .min_filter = GL_LINEAR,
		                     .mag_filter = GL_LINEAR, .max_lod = 1000, .min_lod = -1000, .max_anisotropy = 1,
		                     .env_mode = GL_MODULATE, .scale_rgb = 1, .scale_alpha = 1 };
	for (int k = 0; k < 4; k++)
		unit->matrix[5 * k] = 1;
	made->scene.units = unit;
	made->scene.n_units = 1;
	made->scene.textures = (const struct scene_texture **)textures;
	made->scene.n_textures = 1;
}

/** One value of a channel; x from the left, y from the top. */
static inline float truth_at(const struct image *img, const char *channel, uint32_t x, uint32_t y)
{
	const float *plane = image_channel(img, channel);

	ck_assert_ptr_nonnull(plane);
	return plane[(size_t)y * img->width + x];
}

/** Beauty must equal the sum of its parts at every pixel. */
static inline void truth_check_closure(const struct image *img)
{
	static const char letters[] = "RGB";

	for (int c = 0; c < 3; c++)
		for (uint32_t y = 0; y < img->height; y++)
			for (uint32_t x = 0; x < img->width; x++) {
				float part[6];
				static const char *const names[] = { "", "gl.", "shadow.", "relight.", "reflect.", "refract." };

				for (int i = 0; i < 6; i++) {
					char name[16];

					snprintf(name, sizeof(name), "%s%c", names[i], letters[c]);
					part[i] = truth_at(img, name, x, y);
				}
				ck_assert_float_eq_tol(part[0], part[1] * part[2] + part[3] + part[4] + part[5],
				                       fabsf(part[0]) * 0x1p-9f + 1e-6f);
			}
}

/** Render on the device named by the environment variable RELUME_TEST_DEVICE (default: "reference"). */
static inline void truth_render_with(const struct made *made, const struct tracer_options *options, struct image *img)
{
	const char *choice = getenv("RELUME_TEST_DEVICE");
	struct device *dev = NULL;
	struct tracer *tracer = NULL;

	memset(img, 0, sizeof(*img));
	ck_assert_int_eq(made->err, 0);
	ck_assert_int_eq(device_open(choice ? choice : "reference", 0, &dev), 0);
	ck_assert_int_eq(tracer_create(&tracer, dev), 0);
	ck_assert_int_eq(tracer_render(tracer, &made->scene, options, img), 0);
	tracer_destroy(&tracer);
	device_close(&dev);
}

static inline void truth_render(const struct made *made, const char *mode, struct image *img)
{
	struct tracer_options options = { .mode = strcmp(mode, "gl") == 0 ? TRACER_GL : TRACER_WHITTED, .display = 1,
		                          .depth = 4 };

	truth_render_with(made, &options, img);
}
