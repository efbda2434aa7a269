/*
 * Pictures drawn by calls in any order with any values (calls.h): kernels and C twins must not crash, and must agree to
 * the last bit. A picture read by a call is continued afterwards, and must equal that of the whole scene.
 *
 * limit: 400 s
 */
#include <stdlib.h>
#include <string.h>

#include "tests/case.h"
#include "tests/fuzz/calls.h"
#include "tests/fuzz/kept.h"
#include "verbs/render/supply.h"
#include "tracer/frame/common/picture_kept.h"

#define N_PARTS 13
#define N_RANDOM 8
#define CALLS_A_RUN 200
#define MOST_TWICE 32 /* limit on instances for drawing a scene again as a whole */

enum { TWIN, KERNELS, N_DEVICES };

static uint8_t bytes[KEPT_LARGEST];

struct painter {
	struct device *dev[N_DEVICES];
	struct tracer *tracer[N_DEVICES];
	struct supply supply, whole;
	const char *what; /* picture being drawn */
	int number, part;
	unsigned n_drawn;
};

static void paint(void *user, const struct scene *scene)
{
	const struct tracer_options options = { .mode = TRACER_WHITTED, .display = 1, .depth = 4 };
	struct painter *p = user;
	struct image image[N_DEVICES] = { 0 };

	if (scene->n_instances == 0 || scene->width == 0 || scene->height == 0)
		return;
	for (int i = 0; i < N_DEVICES; i++)
		ck_assert_int_eq(tracer_render(p->tracer[i], scene, &options, &image[i]), 0);
	ck_assert_uint_eq(image[TWIN].n_channels, image[KERNELS].n_channels);
	for (size_t c = 0; c < image[TWIN].n_channels; c++) {
		const float *twin = image_values(&image[TWIN], c), *kernels = image_values(&image[KERNELS], c);
		size_t n = (size_t)image[TWIN].width * image[TWIN].height, different = 0;
		for (size_t k = 0; k < n; k++)
			different += memcmp(&twin[k], &kernels[k], sizeof(float)) != 0;
		ck_assert_msg(!different, "%s %d of part %d: %zu of %zu values of %s differ", p->what, p->number,
		              p->part, different, n, image[TWIN].channels[c].name);
	}
	for (int i = 0; i < N_DEVICES; i++)
		image_free(&image[i]);
	p->n_drawn++;
}

/* Draw a scene as if it were a different, new one, and require the same picture. */
static void compare_whole(struct painter *p, const struct scene *scene, const struct scene_picture *picture)
{
	const size_t n = (size_t)scene->width * scene->height;
	struct scene other = *scene;
	struct scene_picture *whole = picture_blank(scene);

	other.serial = 0;
	ck_assert_ptr_nonnull(whole);
	ck_assert_int_eq(supply_picture(&p->whole, &other, whole), 0);
	ck_assert_msg(!memcmp(whole->rgba, picture->rgba, 4 * n) &&
	                      !memcmp(whole->depth, picture->depth, n * sizeof(*whole->depth)) &&
	                      !memcmp(whole->stencil, picture->stencil, n) &&
	                      (!whole->colors || !memcmp(whole->colors, picture->colors, 4 * n * sizeof(float))),
	              "%s %d of part %d: drawing over a picture differs from the whole", p->what, p->number,
	              p->part);
	picture_free(whole);
}

static int supply(void *user, const struct scene *scene, struct scene_picture *picture)
{
	struct painter *p = user;
	int err = supply_picture(&p->supply, scene, picture);

	if (!err && !scene->before && scene->n_instances <= MOST_TWICE)
		compare_whole(p, scene, picture);
	return err;
}

static void open_painter(struct painter *p, int part)
{
	*p = (struct painter){ .part = part };
	ck_assert_int_eq(device_open("reference", 1, &p->dev[TWIN]), 0);
	ck_assert_int_eq(device_open(NULL, 1, &p->dev[KERNELS]), 0);
	for (int i = 0; i < N_DEVICES; i++)
		ck_assert_int_eq(tracer_create(&p->tracer[i], p->dev[i]), 0);
	p->supply.parent = p->whole.parent = p->dev[TWIN];
}

static void close_painter(struct painter *p)
{
	ck_assert_uint_gt(p->n_drawn, 10);
	supply_free(&p->supply);
	supply_free(&p->whole);
	for (int i = 0; i < N_DEVICES; i++) {
		tracer_destroy(&p->tracer[i]);
		device_close(&p->dev[i]);
	}
}

START_TEST(kept_pictures)
{
	struct painter p;
	const struct calls_painter painter = { .paint = paint, .supply = supply, .user = &p };
	FILE *file = fopen(KEPT, "rb");
	size_t size;

	ck_assert_msg(file != NULL, "no " KEPT);
	open_painter(&p, _i);
	p.what = "kept sequence";
	for (; kept_next(file, bytes, &size); p.number++)
		if (p.number % N_PARTS == _i)
			calls_run(bytes, size, &painter);
	close_painter(&p);
	fclose(file);
}
END_TEST

START_TEST(random_pictures)
{
	struct painter p;
	const struct calls_painter painter = { .paint = paint, .supply = supply, .user = &p };
	unsigned state = (unsigned)_i;

	open_painter(&p, _i);
	p.what = "random sequence";
	for (; p.number < N_RANDOM; p.number++) {
		for (unsigned i = 0; i < CALLS_A_RUN; i++)
			calls_invent(&state, bytes + (size_t)i * CALLS_SLOT, i ? bytes + (size_t)(i - 1) * CALLS_SLOT : NULL);
		calls_run(bytes, CALLS_A_RUN * CALLS_SLOT, &painter);
	}
	close_painter(&p);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("pictures");

	tcase_add_loop_test(tcase, kept_pictures, 0, N_PARTS);
	tcase_add_loop_test(tcase, random_pictures, 0, N_PARTS);
	return run_case(tcase, "pictures");
}
