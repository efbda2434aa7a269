/*
 * Each scene of `relume devices --check` must exercise its features: without one of them its picture must differ by
 * more than the check's bounds, so that a device with that fault is found.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "tests/case.h"
#include "tests/truth/scenes.h"
#include "verbs/render/check/check.h"

enum { WIDTH = 93, HEIGHT = 67, RINGS = 12 };

/* Change all materials. */
#define ALL(w, field, value) \
	do { \
		for (uint32_t i = 0; i < MADE_MAX; i++) \
			(w)->made.materials[i].field = (value); \
	} while (0)

static void no_first_light(struct check_world *w)
{
	memset(w->made.lights[0].diffuse, 0, sizeof(w->made.lights[0].diffuse));
}

static void no_highlights(struct check_world *w)
{
	memset(w->made.lights[0].specular, 0, sizeof(w->made.lights[0].specular));
}

static void no_textures(struct check_world *w)
{
	ALL(w, unit_count, 0);
}

static void no_smaller_levels(struct check_world *w)
{
	w->unit.min_filter = GL_LINEAR;
}

static void no_fog(struct check_world *w)
{
	ALL(w, fog, 0);
}

static void no_lines(struct check_world *w)
{
	ALL(w, polygon_mode_front, GL_FILL);
}

static void no_points(struct check_world *w)
{
	ALL(w, polygon_mode_back, GL_FILL);
}

static void no_flat_shading(struct check_world *w)
{
	ALL(w, shade_model, GL_SMOOTH);
}

static void no_rays(struct check_world *w)
{
	w->options.mode = TRACER_GL;
}

static void no_blending(struct check_world *w)
{
	ALL(w, blend, 0);
}

static void no_alpha_test(struct check_world *w)
{
	ALL(w, alpha_test, 0);
}

static void no_stencil_test(struct check_world *w)
{
	ALL(w, stencil_test, 0);
}

/* Disable the effect of a volume's hidden faces. */
static void no_volume(struct check_world *w)
{
	ALL(w, stencil_back.zfail, GL_KEEP);
}

static void no_bounces(struct check_world *w)
{
	w->options.depth = 0;
}

static void no_roughness(struct check_world *w)
{
	ALL(w, surface.roughness, 0);
}

static void no_glass(struct check_world *w)
{
	ALL(w, surface.transmit, 0);
}

static void no_bending(struct check_world *w)
{
	ALL(w, surface.ior, 1);
}

static void no_absorption(struct check_world *w)
{
	for (uint32_t i = 0; i < MADE_MAX; i++)
		memset(w->made.materials[i].surface.absorb, 0, sizeof(w->made.materials[i].surface.absorb));
}

static void short_reach(struct check_world *w)
{
	w->options.reach = 0.5f;
}

static void one_bounce(struct check_world *w)
{
	w->options.mode = TRACER_DIFFUSE;
}

static void sharp_shadows(struct check_world *w)
{
	w->made.lights[0].radius = 0;
}

static void codes_of_light(struct check_world *w)
{
	w->options.display = 1;
}

static void no_lamp(struct check_world *w)
{
	for (uint32_t i = 0; i < MADE_MAX; i++)
		memset(w->made.materials[i].surface.emission, 0, sizeof(w->made.materials[i].surface.emission));
}

static const struct {
	enum check_scene scene;
	const char *what;
	void (*change)(struct check_world *w);
} changes[] = {
	{ CHECK_OPAQUE, "a light", no_first_light },       { CHECK_OPAQUE, "highlights", no_highlights },
	{ CHECK_OPAQUE, "textures", no_textures },         { CHECK_OPAQUE, "levels", no_smaller_levels },
	{ CHECK_OPAQUE, "fog", no_fog },                   { CHECK_OPAQUE, "lines", no_lines },
	{ CHECK_OPAQUE, "points", no_points },             { CHECK_OPAQUE, "flat shading", no_flat_shading },
	{ CHECK_OPAQUE, "shadows", no_rays },              { CHECK_BLENDED, "blending", no_blending },
	{ CHECK_BLENDED, "the alpha test", no_alpha_test }, { CHECK_STENCIL, "the stencil test", no_stencil_test },
	{ CHECK_STENCIL, "a shadow volume", no_volume },   { CHECK_MIRROR, "mirrors", no_bounces },
	{ CHECK_MIRROR, "roughness", no_roughness },       { CHECK_GLASS, "glass", no_glass },
	{ CHECK_GLASS, "refraction", no_bending },         { CHECK_GLASS, "absorption", no_absorption },
	{ CHECK_AO, "reach", short_reach },                { CHECK_PATH, "bounces", one_bounce },
	{ CHECK_PATH, "soft shadows", sharp_shadows },     { CHECK_LINEAR, "linear light", codes_of_light },
	{ CHECK_LINEAR, "a lamp", no_lamp },               { CHECK_LINEAR, "roughness", no_roughness },
	{ CHECK_LINEAR, "glass", no_glass },
};

/* Draw a scene with the C twins, modified by `change` unless that is NULL. */
static void draw(enum check_scene scene, void (*change)(struct check_world *w), struct image *img)
{
	struct check_world *w = malloc(sizeof(*w));

	ck_assert_ptr_nonnull(w);
	ck_assert_int_eq(check_world_make(scene, WIDTH, HEIGHT, RINGS, w), 0);
	if (change)
		change(w);
	truth_render_with(&w->made, &w->options, img);
	check_world_free(w);
	free(w);
}

START_TEST(test_each_shows)
{
	struct image want, found;
	uint32_t n_differ = 0;
	char channel[32] = "";

	draw(changes[_i].scene, NULL, &want);
	ck_assert_int_eq(check_compare(&want, &want, &n_differ, channel), OUTCOME_RIGHT);
	ck_assert_uint_eq(n_differ, 0);
	draw(changes[_i].scene, changes[_i].change, &found);
	ck_assert_msg(check_compare(&want, &found, &n_differ, channel) == OUTCOME_WRONG,
	              "%s without %s: %u pixels of %s differ", check_scene_names[changes[_i].scene], changes[_i].what,
	              n_differ, channel);
	image_free(&want);
	image_free(&found);
}
END_TEST

/* NaN, values out of bounds at a pixel in a thousand, or missing ones. */
START_TEST(test_bounds)
{
	struct image want, found;
	uint32_t n_differ = 0;
	char channel[32] = "";
	float *red;

	draw(CHECK_OPAQUE, NULL, &want);
	draw(CHECK_OPAQUE, NULL, &found);
	red = image_channel(&found, "R");
	for (int i = 0; i < WIDTH * HEIGHT / 1000; i++)
		red[i] = i % 2 ? NAN : red[i] + 0.1f;
	ck_assert_int_eq(check_compare(&want, &found, &n_differ, channel), OUTCOME_RIGHT);
	ck_assert_uint_eq(n_differ, WIDTH * HEIGHT / 1000);
	ck_assert_str_eq(channel, "R");
	red[WIDTH] = INFINITY;
	ck_assert_int_eq(check_compare(&want, &found, &n_differ, channel), OUTCOME_WRONG);
	found.height--;
	ck_assert_int_eq(check_compare(&want, &found, &n_differ, channel), OUTCOME_WRONG);
	found.height++;
	image_free(&want);
	image_free(&found);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("check_scenes");

	tcase_set_timeout(tests, 60);
	tcase_add_loop_test(tests, test_each_shows, 0, sizeof(changes) / sizeof(changes[0]));
	tcase_add_test(tests, test_bounds);
	return run_case(tests, "check_scenes");
}
