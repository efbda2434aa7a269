#include "verbs/bisect/sights.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/folder.h"
#include "replay/replay.h"
#include "scene/release.h"
#include "tracer/device/outcome.h"
#include "tracer/image/display.h"
#include "verbs/render/supply.h"

enum { PNG_LEVEL = 6, MOST_NAME = 4096 };

/* Renders frames of both recordings, on one device. */
struct eyes {
	struct replay *replays[N_SIDES];
	struct device *dev;
	struct tracer *tracer;
	struct supply supply;
	struct display *display;
};

static int open_eyes(struct eyes *e, const char *good, const char *bad, const char *device)
{
	char folder[MOST_NAME];
	int err = replay_open(&e->replays[GOOD], good);

	if (!err)
		err = replay_open(&e->replays[BAD], bad);
	if (!err)
		err = device_open(device, 0, &e->dev);
	if (!err)
		err = outcome_choose_known(e->dev);
	if (!err && folder_cached("kernels", folder, sizeof(folder)))
		device_keep_programs(e->dev, folder, 0);
	if (!err)
		err = tracer_create(&e->tracer, e->dev);
	if (!err)
		err = display_create(&(struct display_options){ .white = 1, .rounds = 1 }, &e->display);
	e->supply.parent = e->dev;
	for (int s = 0; s < N_SIDES && !err; s++)
		replay_set_supplier(e->replays[s], supply_picture, &e->supply);
	return err;
}

static void close_eyes(struct eyes *e)
{
	display_destroy(&e->display);
	supply_free(&e->supply);
	tracer_destroy(&e->tracer);
	if (e->dev)
		device_close(&e->dev);
	replay_close(&e->replays[GOOD]);
	replay_close(&e->replays[BAD]);
}

/* Render a frame. @param out  receives its picture; rgb is freed by the caller, also after an error */
static int look(struct eyes *e, int side, size_t frame, struct oiio_pixels *out)
{
	const struct tracer_options options = { .mode = TRACER_GL, .samples = 1, .aov = "gl" };
	struct scene *scene = NULL;
	struct image img = { .width = 0 };
	int rc = replay_seek(e->replays[side], frame);

	if (rc == 1)
		rc = replay_next_frame(e->replays[side], 1, &scene);
	if (rc != 1)
		return rc ? rc : err_report(ERR_SYSTEM, NULL, "frame %zu is not there", frame);
	rc = tracer_render(e->tracer, scene, &options, &img);
	scene_release(&scene);
	if (!rc) {
		*out = (struct oiio_pixels){ malloc(3 * (size_t)img.width * img.height + 1), img.width, img.height };
		rc = out->rgb ? display_codes(e->display, &img, "gl.", out->rgb, NULL) :
		                err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	image_free(&img);
	return rc;
}

static void drop_pictures(struct sight *s)
{
	for (int side = 0; side < N_SIDES; side++) {
		free(s->pictures[side].rgb); /* NOLINT(clang-analyzer-unix.Malloc): set to NULL below */
		s->pictures[side] = (struct oiio_pixels){ .rgb = NULL };
	}
}

static void compare(struct sight *s)
{
	const struct oiio_pixels *g = &s->pictures[GOOD], *b = &s->pictures[BAD];

	s->pixels = (uint64_t)g->width * g->height;
	s->differing = s->worst = 0;
	s->is_found = g->width != b->width || g->height != b->height;
	if (s->is_found) {
		s->differing = s->pixels;
		s->worst = 255;
		return;
	}
	for (uint64_t i = 0; i < s->pixels; i++) {
		int worst = 0;

		for (int c = 0; c < 3; c++) {
			const int off = abs(g->rgb[3 * i + (uint64_t)c] - b->rgb[3 * i + (uint64_t)c]);

			worst = off > worst ? off : worst;
		}
		s->differing += worst > 0;
		s->worst = (unsigned)worst > s->worst ? (unsigned)worst : s->worst;
	}
	s->is_found = s->differing > 0;
}

int sight_find(const struct partners *partners, const struct recording *good, const struct recording *bad, size_t first,
               size_t most, const char *device, struct sight *out)
{
	struct eyes eyes = { .dev = NULL };
	int err;

	*out = (struct sight){ .looked = 0 };
	err = open_eyes(&eyes, good->path, bad->path, device);
	for (size_t f = first; f < good->n_ended && !err && !out->is_found; f++) {
		const size_t other = partners->frames[f];

		if (other >= bad->n_ended) /* or has no partner */
			continue;
		if (out->looked == most) {
			out->left++;
			continue;
		}
		drop_pictures(out);
		err = look(&eyes, GOOD, f, &out->pictures[GOOD]);
		if (!err)
			err = look(&eyes, BAD, other, &out->pictures[BAD]);
		if (!err)
			compare(out);
		out->looked++;
		out->frame[GOOD] = f;
		out->frame[BAD] = other;
	}
	close_eyes(&eyes);
	return err;
}

void sight_free(struct sight *sight)
{
	drop_pictures(sight);
}

static int save(const struct oiio_pixels *pixels, const char *folder, const char *name)
{
	char path[MOST_NAME];

	if (snprintf(path, sizeof(path), "%s/%s", folder, name) >= (int)sizeof(path))
		return err_report(ERR_USAGE, folder, "the name is too long");
	return display_save(pixels, &(struct oiio_coding){ "png", .level = PNG_LEVEL }, path);
}

int sight_write(const struct sight *s, const char *folder)
{
	const struct oiio_pixels *g = &s->pictures[GOOD], *b = &s->pictures[BAD];
	const int is_one_size = g->width == b->width && g->height == b->height;
	struct oiio_pixels off = { calloc(3 * (size_t)g->width * g->height + 1, 1), g->width, g->height };
	int err = off.rgb ? folder_make(folder) : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (size_t i = 0; !err && is_one_size && i < 3 * (size_t)g->width * g->height; i++)
		off.rgb[i] = g->rgb[i] == b->rgb[i] ? 0 : 255;
	if (!err)
		err = save(g, folder, "good.png");
	if (!err)
		err = save(b, folder, "bad.png");
	if (!err)
		err = save(&off, folder, "difference.png");
	free(off.rgb);
	return err;
}
