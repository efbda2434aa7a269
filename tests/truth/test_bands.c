/*
 * A frame is drawn in bands of rows; the result must not depend on their number. Frames with blending, stencil,
 * scissors, mirrors, glass, several samples per pixel, several passes, and existing pixels.
 */
#include <stdlib.h>
#include <string.h>

#include "tests/case.h"
#include "tests/truth/scenes.h"

enum { WIDTH = 45, HEIGHT = 100, PIXELS = WIDTH * HEIGHT };

static uint8_t start_rgba[4 * PIXELS], start_stencil[PIXELS];
static uint32_t start_depth[PIXELS];

static uint32_t glass(struct made *t)
{
	uint32_t m = made_add_material(t, 0.8f);

	t->materials[m].surface.transmit = 0.7f;
	t->materials[m].surface.reflect = 0.2f;
	t->materials[m].surface.ior = 1.4f;
	return m;
}

static uint32_t film(struct made *t)
{
	uint32_t m = made_add_material(t, 0.3f);

	t->materials[m].blend = 1;
	t->materials[m].depth_write = 0;
	t->materials[m].blend_src_rgb = t->materials[m].blend_src_alpha = GL_ONE;
	t->materials[m].blend_dst_rgb = t->materials[m].blend_dst_alpha = GL_ONE;
	return m;
}

/* Writes the stencil buffer where it passes, and draws only where the buffer allows. */
static uint32_t stencilled(struct made *t, uint32_t func)
{
	struct scene_material *m;
	uint32_t i = made_add_material(t, 0.6f);

	m = &t->materials[i];
	m->stencil_test = 1;
	m->stencil_front = (struct scene_stencil){
		.func = func, .ref = 1, .compare_mask = 255, .write_mask = 255, .fail = GL_KEEP, .zfail = GL_KEEP,
		.zpass = GL_REPLACE
	};
	m->stencil_back = m->stencil_front;
	return i;
}

static void fill(struct made *t, int plain)
{
	const float right[3] = { 1, 0, 0 }, up[3] = { 0, 1, 0 }, tilted[3] = { 0, 0.8f, -0.6f };
	uint32_t matte;

	made_init(t, WIDTH, HEIGHT, 0.6f);
	made_add_light(t, 2, 6, 0, 1);
	matte = made_add_material(t, 0.9f);
	made_add_square(t, matte, (float[3]){ 0, 0, -20 }, right, up, 9, 7);
	made_add_square(t, matte, (float[3]){ 1, 1, -9 }, right, up, 0.7f, 1);
	if (plain)
		return;
	made_add_square(t, glass(t), (float[3]){ -1, -2, -10 }, right, tilted, 2, 2);
	made_add_square(t, stencilled(t, GL_ALWAYS), (float[3]){ 0, 3, -8 }, right, up, 0.9f, 1);
	made_add_square(t, stencilled(t, GL_EQUAL), (float[3]){ 0.5f, 3.5f, -7 }, right, up, 0.9f, 1);
	made_add_square(t, film(t), (float[3]){ 0, -1, -6 }, right, up, 1.5f, 2);
}

static void compare(const struct image *a, const struct image *b, const char *what, unsigned rows)
{
	ck_assert_uint_eq(a->n_channels, b->n_channels);
	for (size_t i = 0; i < a->n_channels; i++) {
		const float *x = image_values(a, i), *y = image_values(b, i);

		for (int p = 0; p < PIXELS; p++)
			ck_assert_msg(memcmp(x + p, y + p, sizeof(*x)) == 0, "%s: %s at %d %d is %.9g in bands of %u rows, else %.9g", what,
			              a->channels[i].name, p % WIDTH, p / WIDTH, (double)y[p], rows, (double)x[p]);
	}
}

static void check(struct tracer *tracer, const struct made *t, struct tracer_options options, const char *what)
{
	static const unsigned rows[] = { 1, 64 }; /* 1: the smallest bands */
	struct image whole = { .width = 0 };

	options.band_rows = HEIGHT + 32;
	ck_assert_int_eq(tracer_render(tracer, &t->scene, &options, &whole), 0);
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct image bands = { .width = 0 };

		options.band_rows = rows[i];
		ck_assert_int_eq(tracer_render(tracer, &t->scene, &options, &bands), 0);
		compare(&whole, &bands, what, rows[i]);
		image_free(&bands);
	}
	image_free(&whole);
}

START_TEST(test_number_of_bands)
{
	const struct tracer_options options = { .mode = TRACER_WHITTED, .depth = 4 };
	const struct scene_picture start = { .width = WIDTH, .height = HEIGHT, .depth_bits = 24, .rgba = start_rgba,
		                             .depth = start_depth, .stencil = start_stencil };
	struct tracer_options several = options;
	const char *choice = getenv("RELUME_TEST_DEVICE");
	struct device *dev = NULL;
	struct tracer *tracer = NULL;
	struct made t;

	several.samples = 2;
	ck_assert_int_eq(device_open(choice ? choice : "reference", 0, &dev), 0);
	ck_assert_int_eq(tracer_create(&tracer, dev), 0);
	for (int plain = 0; plain < 2; plain++) {
		fill(&t, plain);
		check(tracer, &t, options, plain ? "a plain frame" : "a frame");
		t.view.scissor[1] = 41, t.view.scissor[3] = 50;
		check(tracer, &t, options, "a scissor");
		check(tracer, &t, several, "several passes");
		t.scene.samples = SCENE_SAMPLES;
		for (uint32_t i = 0; i < t.scene.n_materials; i++)
			t.materials[i].multisample = 1;
		check(tracer, &t, options, "several samples");
		t.scene.samples = 0;
		t.scene.start = &start;
		t.scene.n_clears = 0;
		for (uint32_t i = 0; i < PIXELS; i++) {
			start_rgba[4 * i] = (uint8_t)(i * 7);
			start_depth[i] = i % WIDTH < 20 ? 0 : 16777215;
			start_stencil[i] = (uint8_t)(i / WIDTH / 40);
		}
		check(tracer, &t, options, "pixels from before");
		made_free(&t);
	}
	tracer_destroy(&tracer);
	device_close(&dev);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("bands");

	tcase_add_test(tests, test_number_of_bands);
	return run_case(tests, "bands");
}
