#include "verbs/render/check/check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/progress.h"
#include "verbs/render/check/apart.h"

/* Size of the pictures to compare: odd, so that tiles and work groups are cut. The twins draw all of them in a
 * second. */
enum { WIDTH = 93, HEIGHT = 67, RINGS = 12 };

/* Size of the frame to measure. A device that would need longer than SLOW_S for it only draws a small picture. */
enum { FRAME_WIDTH = 480, FRAME_HEIGHT = 360, FRAME_RINGS = 64, FRAME_REPEATS = 3 };
#define SLOW_S 10.0

#define LIST_SECONDS 60
#define MAX_DEVICES 64

static int draw(struct tracer *tracer, const struct check_world *world, struct image *img, double *seconds)
{
	const double begin = progress_clock_s();
	const int err = tracer_render(tracer, &world->made.scene, &world->options, img);

	*seconds = progress_clock_s() - begin;
	return err;
}

/* --- Comparing --------------------------------------------------------------------------------------------------- */

int check_truth_make(struct check_truth *truth)
{
	struct check_world *world = malloc(sizeof(*world));
	struct device *dev = NULL;
	struct tracer *tracer = NULL;
	int err = world ? device_open("reference", 0, &dev) : err_report(ERR_SYSTEM, NULL, "out of memory");
	double seconds;

	if (!err)
		err = tracer_create(&tracer, dev);
	for (int i = 0; i < N_CHECK_SCENES && !err; i++) {
		err = check_world_make((enum check_scene)i, WIDTH, HEIGHT, RINGS, world);
		if (!err)
			err = draw(tracer, world, &truth->pictures[i], &seconds);
		check_world_free(world);
	}
	tracer_destroy(&tracer);
	device_close(&dev);
	free(world);
	return err;
}

void check_truth_free(struct check_truth *truth)
{
	for (int i = 0; i < N_CHECK_SCENES; i++)
		image_free(&truth->pictures[i]);
}

static uint32_t count_differing(const float *a, const float *b, size_t n)
{
	uint32_t differ = 0;

	for (size_t p = 0; p < n; p++)
		differ += !(fabsf(a[p] - b[p]) <= 2e-3f * fmaxf(1, fabsf(a[p]))) && !(isnan(a[p]) && isnan(b[p])) && a[p] != b[p];
	return differ;
}

enum outcome_state check_compare(const struct image *want, const struct image *found, uint32_t *n_differ,
                                 char channel[32])
{
	const size_t n_pixels = (size_t)want->width * want->height;

	if (found->n_channels != want->n_channels || found->width != want->width || found->height != want->height)
		return OUTCOME_WRONG;
	for (size_t i = 0; i < want->n_channels; i++) {
		const float *a = image_values(want, i), *b = image_values(found, i);
		const uint32_t differ = a && b ? count_differing(a, b, n_pixels) : (uint32_t)n_pixels;

		if (differ > *n_differ) {
			*n_differ = differ;
			snprintf(channel, sizeof(want->channels[i].name), "%s", want->channels[i].name);
		}
	}
	return *n_differ <= n_pixels / 1000 ? OUTCOME_RIGHT : OUTCOME_WRONG;
}

/* --- In a process of its own ------------------------------------------------------------------------------------- */

struct listing {
	int err, step;
	size_t n;
	struct device_description list[MAX_DEVICES];
};

static void list_apart(void *user)
{
	struct listing *listing = user;
	struct device_description *list = NULL;

	listing->err = device_list(&list, &listing->n);
	if (listing->n > MAX_DEVICES)
		listing->n = MAX_DEVICES;
	if (!listing->err)
		memcpy(listing->list, list, listing->n * sizeof(*list));
	free(list);
}

int check_list(struct device_description **out, size_t *n)
{
	struct listing *listing = apart_alloc(sizeof(*listing));
	int err = ERR_SYSTEM;

	*out = NULL;
	if (!listing)
		return ERR_SYSTEM;
	if (apart_run(list_apart, listing, &listing->step, LIST_SECONDS) != APART_DONE)
		err_report(ERR_SYSTEM, "OpenCL", "a driver crashes or hangs when it lists its devices");
	else
		err = listing->err;
	*n = listing->n;
	if (!err)
		*out = malloc(*n * sizeof(**out));
	if (*out)
		memcpy(*out, listing->list, *n * sizeof(**out));
	else if (!err)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	apart_free(listing, sizeof(*listing));
	return err;
}

/* Shared by both processes. */
struct drawing {
	const struct check_truth *truth;
	size_t device;
	enum device_family family;
	struct fault_journal journal;
	volatile int at; /* the scene that is being drawn; N_CHECK_SCENES: the frame to measure */
	struct check_result result;
};

/* Draw a scene twice: the first time includes compiling. @return seconds of the second, 0: it failed */
static double check_scene(struct tracer *tracer, struct check_world *world, struct drawing *d)
{
	struct image img = { .width = 0 }, again = { .width = 0 };
	uint32_t *n_differ = &d->result.scenes[d->at].n_differ;
	enum outcome_state state = OUTCOME_FAILED;
	double cold_s = 0, warm_s = 0;
	int err = check_world_make((enum check_scene)d->at, WIDTH, HEIGHT, RINGS, world);

	if (!err)
		err = draw(tracer, world, &img, &cold_s);
	if (!err)
		err = draw(tracer, world, &again, &warm_s);
	if (!err)
		state = check_compare(&d->truth->pictures[d->at], &img, n_differ, d->result.scenes[d->at].channel);
	if (!err && state == OUTCOME_RIGHT)
		state = check_compare(&d->truth->pictures[d->at], &again, n_differ, d->result.scenes[d->at].channel);
	if (!err && cold_s > warm_s)
		d->result.all.compile_s += cold_s - warm_s;
	d->result.scenes[d->at].state = (int)state;
	image_free(&img);
	image_free(&again);
	check_world_free(world);
	return err ? 0 : warm_s;
}

/* The quickest of some frames. @param small_s  what a small picture took */
static double measure(struct tracer *tracer, struct check_world *world, double small_s)
{
	double seconds, best = small_s * FRAME_WIDTH * FRAME_HEIGHT / (WIDTH * HEIGHT);
	int err;

	if (best > SLOW_S)
		return best;
	err = check_world_make(CHECK_OPAQUE, FRAME_WIDTH, FRAME_HEIGHT, FRAME_RINGS, world);
	for (int i = 0; i <= FRAME_REPEATS && !err; i++) {
		struct image img = { .width = 0 };

		err = draw(tracer, world, &img, &seconds);
		if (i == 1 || (i > 1 && seconds < best)) /* the first one builds trees */
			best = seconds;
		image_free(&img);
	}
	check_world_free(world);
	return err ? 0 : best;
}

static void draw_apart(void *user)
{
	struct drawing *d = user;
	struct check_world *world = malloc(sizeof(*world));
	struct device *dev = NULL;
	struct tracer *tracer = NULL;
	char number[24];
	double small_s = 0;
	int err;

	fault_begin(&d->journal, 0);
	setenv("POCL_KERNEL_CACHE", "0", 0);
	snprintf(number, sizeof(number), "%zu", d->device);
	err = world ? device_open(number, 0, &dev) : err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err) {
		device_choose_family(dev, d->family);
		err = tracer_create(&tracer, dev);
	}
	for (int i = 0; i < N_CHECK_SCENES && !err; i++) {
		double seconds;

		d->at = i;
		seconds = check_scene(tracer, world, d);
		if (i == CHECK_OPAQUE)
			small_s = seconds;
	}
	d->at = N_CHECK_SCENES;
	if (small_s > 0)
		d->result.all.frame_s = measure(tracer, world, small_s);
	tracer_destroy(&tracer);
	device_close(&dev);
	free(world);
}

/* Sum the scenes up: the first state that is not right, the names of all scenes that are not, and the driver's
 * fault. */
static void sum_up(struct check_result *r, const struct fault *fault)
{
	char text[160];
	size_t at = 0;

	r->all.state = OUTCOME_RIGHT;
	for (int i = 0; i < N_CHECK_SCENES; i++) {
		if (r->scenes[i].state == OUTCOME_RIGHT || r->scenes[i].state < 0)
			continue;
		if (r->all.state == OUTCOME_RIGHT)
			r->all.state = (uint32_t)r->scenes[i].state;
		at += (size_t)snprintf(r->all.where + at, sizeof(r->all.where) - at, at ? ", %s" : "%s", check_scene_names[i]);
	}
	if (fault->kind != FAULT_NONE)
		snprintf(r->all.where + at, sizeof(r->all.where) - at, ": %s", fault_words(fault, text, sizeof(text)));
}

int check_family(const struct check_truth *truth, size_t device, enum device_family family, double seconds,
                 struct check_result *out)
{
	struct drawing *d = apart_alloc(sizeof(*d));
	enum apart_end end;

	if (!d)
		return ERR_SYSTEM;
	d->truth = truth;
	d->device = device;
	d->family = family;
	for (int i = 0; i < N_CHECK_SCENES; i++)
		d->result.scenes[i].state = -1;
	end = apart_run(draw_apart, d, &d->at, seconds);
	if (end != APART_DONE || d->result.scenes[0].state < 0) /* it ended, or did not even open the device */
		d->result.scenes[d->at < N_CHECK_SCENES ? d->at : CHECK_OPAQUE].state = end == APART_LATE ?
		                                                                                OUTCOME_LATE :
		                                                                                OUTCOME_FAILED;
	*out = d->result;
	sum_up(out, &d->journal.fault);
	apart_free(d, sizeof(*d));
	return 0;
}
