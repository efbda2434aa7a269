/*
 * The shading kernels on an OpenCL device against the same text compiled as C: one scene with every feature that
 * affects shading (lights near and far, specular, two sides, flat and smooth, fog, blending, shadows, a mirror, glass),
 * channel by channel; with one sample per pixel and with several, and under rules.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/case.h"
#include "tests/truth/scenes.h"

#define SIZE 64

static void make_scene(struct made *t)
{
	const float x[3] = { 1, 0, 0 }, y[3] = { 0, 1, 0 }, r = sqrtf(0.5f);
	uint32_t floor, mirror, film, flat, glass;

	made_init(t, SIZE, SIZE, 0.6f);
	made_add_light(t, 2, 3, -2, 1);
	t->lights[0].specular[0] = t->lights[0].specular[1] = 1;
	t->lights[0].attenuation[1] = 0.05f;
	made_add_light(t, -1, 1, 1, 0);
	t->lights[1].diffuse[2] = 0.25f;
	t->lights[1].ambient[0] = 0.1f;
	floor = made_add_material(t, 0.7f);
	t->materials[floor].front.specular[0] = 0.5f;
	t->materials[floor].front.shininess = 12;
	t->materials[floor].fog = 1;
	t->materials[floor].fog_mode = GL_EXP;
	t->materials[floor].fog_density = 0.02f;
	mirror = made_add_material(t, 0.4f);
	t->materials[mirror].surface.reflect = 0.6f;
	t->materials[mirror].two_side = t->materials[mirror].local_viewer = 1;
	film = made_add_material(t, 0.9f);
	t->materials[film].blend = 1;
	t->materials[film].blend_src_rgb = t->materials[film].blend_src_alpha = GL_DST_COLOR;
	t->materials[film].blend_dst_rgb = t->materials[film].blend_dst_alpha = GL_ONE;
	t->materials[film].depth_write = 0;
	flat = made_add_material(t, 0.5f);
	t->materials[flat].shade_model = GL_FLAT;
	glass = made_add_material(t, 0.8f);
	t->materials[glass].surface.transmit = 0.8f;
	t->materials[glass].surface.ior = 1.4f;
	t->materials[glass].surface.absorb[2] = 0.3f;
	made_add_square(t, floor, (float[3]){ 0, 0, -12 }, x, y, 6, 6);
	made_add_square(t, glass, (float[3]){ -0.9f, 1.2f, -7 }, (float[3]){ r, 0, r }, y, 0.9f, 2);
	made_add_square(t, mirror, (float[3]){ -1, -1, -8 }, (float[3]){ r, 0, r }, y, 1.3f, 2);
	made_add_square(t, flat, (float[3]){ 1.2f, 0.6f, -7 }, x, (float[3]){ 0, r, r }, 0.8f, 3);
	made_add_square(t, film, (float[3]){ 0.3f, -0.5f, -5 }, x, y, 0.9f, 1);
}

/* Four samples per pixel; the film and its tests cover all samples of a pixel. */
static void take_samples(struct made *t)
{
	t->scene.samples = SCENE_SAMPLES;
	for (uint32_t m = 0; m < MADE_MAX; m++)
		t->materials[m].multisample = !t->materials[m].blend;
	t->materials[0].samples_off = 2;
}

/* Lamps from rules, the last one a spot: for the wall instead of OpenGL's own lights, and for surfaces that OpenGL
 * does not light. */
static void take_lamps(struct made *t)
{
	struct scene_light *spot = &t->lights[made_add_light(t, 0.5f, 2, -5, 1)];

	spot->spot_direction_eye[1] = -0.5f;
	spot->spot_cutoff_deg = 50;
	spot->spot_exponent = 4;
	spot->attenuation[2] = 0.02f;
	spot->specular[0] = 0.5f;
	t->materials[0].surface.relit = t->materials[3].surface.relit = 1;
	t->materials[0].surface.light_first = 1;
	t->materials[0].surface.light_count = 2;
	t->materials[3].surface.light_count = 3;
	t->materials[3].lighting = 0;
}

/* Rules: ambient occlusion, where some rays hit the ground; glossy highlights of near objects, a blended board that
 * reflects. */
static void take_rules(struct made *t)
{
	t->scene.dome = (struct scene_dome){ .up_eye = { 0, 1, 0 },
		                             .reach = 6,
		                             .light = { 1, 0.9f, 0.8f },
		                             .ground = { 0.3f, 0.3f, 0.5f },
		                             .lit = 0.8f };
	for (uint32_t m = 0; m < MADE_MAX; m++)
		t->materials[m].surface.hidden |= SCENE_DOME_LIT;
	t->materials[0].surface.hidden |= SCENE_NEAR_MIRROR;
	t->materials[0].surface.reflect = 0.2f;
	t->materials[0].surface.roughness = 0.15f;
	t->materials[0].fog_mode = GL_LINEAR;
	t->materials[0].fog_end = 30;
	t->materials[1].blend = 1;
	t->materials[1].surface.hidden |= SCENE_SOLID;
	t->materials[3].surface.hidden |= SCENE_NEAR_MIRROR;
	t->materials[3].surface.reflect = 0.3f;
	take_lamps(t);
}

START_TEST(test_device_against_twins)
{
	struct device_description *devices = NULL;
	struct made t;
	struct image c, cl;
	size_t n = 0;

	if (device_list(&devices, &n) != 0 || n == 0)
		return; /* no OpenCL here; reported on standard error */
	make_scene(&t);
	if (_i == 1)
		take_samples(&t);
	if (_i == 2)
		take_rules(&t);
	setenv("RELUME_TEST_DEVICE", "reference", 1);
	truth_render(&t, "whitted", &c);
	truth_check_closure(&c);
	for (size_t d = 0; d < n; d++) {
		char number[24];

		snprintf(number, sizeof(number), "%zu", d);
		setenv("RELUME_TEST_DEVICE", number, 1);
		truth_render(&t, "whitted", &cl);
		ck_assert_uint_eq(cl.n_channels, c.n_channels);
		for (size_t i = 0; i < c.n_channels; i++) {
			uint32_t differ = 0;

			for (size_t p = 0; p < SIZE * SIZE; p++) {
				float a = image_values(&c, i)[p], b = image_values(&cl, i)[p];

				differ += !(fabsf(a - b) <= 2e-3f * fmaxf(1, fabsf(a)));
			}
			/* A ray that grazes an edge may pass on either side of it. */
			ck_assert_msg(differ <= SIZE * SIZE / 1000, "channel %s differs at %u pixels on device %zu",
			              c.channels[i].name, differ, d);
		}
		image_free(&cl);
	}
	image_free(&c);
	made_free(&t);
	free(devices);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("devices");

	tcase_set_timeout(tests, 240);
	tcase_add_loop_test(tests, test_device_against_twins, 0, 3); /* one sample per pixel, several, rules */
	return run_case(tests, "shade");
}
