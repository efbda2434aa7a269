/* relume denoise: removes noise from rendered frames, with the help of frames before and after them. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/frames.h"
#include "base/options.h"
#include "base/part.h"
#include "base/progress.h"
#include "base/verbs.h"
#include "diff/pictures/set.h"
#include "verbs/film/filter.h"
#include "verbs/film/oidn.h"

#define MOST_REACH 8u

struct asked {
	const char *frames_of, *output;
	struct frame_list frames;
	unsigned reach;
	int no_time, oidn;
};

static const struct options_row rows[] = {
	{ "output", 'o', "PATTERN", "file names, .exr: ####, %04d, $F4 or {frame} stand for the frame number",
	  options_text, .at = offsetof(struct asked, output), .is_required = 1 },
	{ "frames", 'f', "LIST", "frames to denoise (default: all that exist); the others help if they exist",
	  options_frames, .at = offsetof(struct asked, frames) },
	{ "reach", 0, "N", "use up to N frames before and after, if channels motion.* tie them together (default 3)",
	  options_number, .at = offsetof(struct asked, reach), .most = MOST_REACH },
	{ "no-time", 0, NULL, "denoise each frame alone", options_flag, .at = offsetof(struct asked, no_time) },
	{ "oidn", 0, NULL, "denoise each frame alone, with Intel's Open Image Denoise 2, which must be installed",
	  options_flag, .at = offsetof(struct asked, oidn) },
};

static const struct options_table table = {
	.verb = "denoise",
	.head = "usage: relume denoise [OPTIONS] FRAMES -o PATTERN\n"
		"\n"
		"Remove noise from rendered frames.\n"
		"\n"
		"FRAMES  made by 'relume render': a folder, or a pattern such as out/gears.####.exr, with channels "
	        "reflect, refract,\n"
		"        albedo, N and Z; --aov motion adds those that tie frames together\n",
	OPTIONS_ROWS(rows),
	.notes = "Channels of effects (shadow, relight, reflect, refract) are left out: they would not add up to the "
	         "new beauty. The same\n"
		 "frames give the same bytes, whichever are asked for at a time.\n"
		 "Exit codes: 0 done, 2 wrong usage, 3 a frame cannot be read, 5 the system failed.\n",
	.takes = "FRAMES and -o PATTERN",
	.least = 1,
	.most = 1,
};

/* A frame that is kept while others need it. */
struct kept {
	uint64_t frame;
	struct image img;
	struct filter_frame taken;
	int is_there;
};

struct denoising {
	const struct asked *asked;
	struct set set;
	struct kept kept[2 * MOST_REACH + 1]; /* in any order */
};

static void drop(struct kept *k)
{
	image_free(&k->img);
	filter_free(&k->taken);
	k->is_there = 0;
}

/* Get a frame after filter_guess, from `kept` or its file. @return 0 (*out NULL: there is none) or ERR_* (reported) */
static int keep(struct denoising *d, uint64_t frame, struct kept **out)
{
	const struct set_entry *entry = set_find(&d->set, frame);
	struct kept *place = NULL;
	const char *where;
	int err;

	*out = NULL;
	if (!entry)
		return 0;
	for (size_t i = 0; i < sizeof(d->kept) / sizeof(d->kept[0]); i++) {
		if (d->kept[i].is_there && d->kept[i].frame == frame) {
			*out = &d->kept[i];
			return 0;
		}
		if (!d->kept[i].is_there)
			place = &d->kept[i];
	}
	where = entry->path ? entry->path : d->set.name;
	err = set_read(&d->set, entry, &place->img);
	if (!err)
		err = filter_take(&place->img, where, &place->taken);
	if (!err)
		err = filter_guess(&place->taken);
	place->frame = frame;
	place->is_there = 1;
	*out = place;
	return err;
}

/* Drop frames outside first .. first + 2 * reach. */
static void forget(struct denoising *d, uint64_t first)
{
	for (size_t i = 0; i < sizeof(d->kept) / sizeof(d->kept[0]); i++)
		if (d->kept[i].is_there && (d->kept[i].frame < first || d->kept[i].frame > first + 2 * (uint64_t)d->asked->reach))
			drop(&d->kept[i]);
}

/* Collect a frame and its neighbours on both sides, up to the first gap or other size. *middle: index of the frame. */
static int gather(struct denoising *d, uint64_t frame, unsigned reach, const struct filter_frame **around, unsigned *n,
                  unsigned *middle)
{
	const struct filter_frame *before[MOST_REACH];
	unsigned n_before = 0;
	struct kept *k;
	int err = keep(d, frame, &k);
	const struct filter_frame *here = err ? NULL : &k->taken;

	for (uint64_t f = frame; n_before < reach && f > 0 && !err; n_before++) {
		err = keep(d, --f, &k);
		if (err || !k || k->taken.width != here->width || k->taken.height != here->height)
			break;
		before[n_before] = &k->taken;
	}
	*n = 0;
	for (unsigned i = n_before; i > 0; i--)
		around[(*n)++] = before[i - 1];
	*middle = *n;
	around[(*n)++] = here;
	for (unsigned i = 1; i <= reach && !err; i++) {
		err = keep(d, frame + i, &k);
		if (err || !k || k->taken.width != here->width || k->taken.height != here->height)
			break;
		around[(*n)++] = &k->taken;
	}
	return err;
}

/* Filter over frames before and after, then over the picture. where: its name, for messages */
static int filter(struct denoising *d, uint64_t frame, const char *where, struct image *img)
{
	const unsigned reach = d->asked->no_time ? 0 : d->asked->reach;
	const struct filter_frame *around[2 * MOST_REACH + 1];
	struct filter_frame work = { .width = 0 };
	unsigned n, middle;
	int err;

	forget(d, frame > reach ? frame - reach : 0);
	err = gather(d, frame, reach, around, &n, &middle);
	if (!err)
		err = filter_take(img, where, &work);
	if (!err)
		err = filter_time(around, n, middle, &work);
	if (!err)
		err = filter_space(&work);
	if (!err)
		err = filter_put(&work, img);
	filter_free(&work);
	return err;
}

static int denoise_frame(struct denoising *d, const struct set_entry *entry)
{
	const char *where = entry->path ? entry->path : d->set.name;
	struct image img = { .width = 0 };
	char path[4096];
	int err = set_read(&d->set, entry, &img);

	if (!err)
		err = d->asked->oidn ? oidn_denoise(&img, where) : filter(d, entry->frame, where, &img);
	if (!err)
		err = frame_pattern_expand(d->asked->output, entry->frame, path, sizeof(path));
	if (!err)
		err = folder_make_for(path);
	if (!err)
		err = image_write_exr(&img, path);
	image_free(&img);
	return err;
}

static int run(struct denoising *d)
{
	struct progress progress;
	uint64_t total = 0;
	int err = 0;

	for (size_t i = 0; i < d->set.n_entries; i++)
		total += frame_list_contains(&d->asked->frames, d->set.entries[i].frame) != 0;
	if (!total)
		return err_report(ERR_INPUT, d->set.name, "holds none of the frames asked for");
	if (total > 1 && !frame_pattern_has_number(d->asked->output))
		return err_report(ERR_USAGE, d->asked->output, "several frames need a name with #### or {frame}");
	part_sweep(d->asked->output);
	progress_begin(&progress, "denoised", total);
	for (size_t i = 0; i < d->set.n_entries && !err; i++) {
		const double start = progress_clock_s();

		if (!frame_list_contains(&d->asked->frames, d->set.entries[i].frame))
			continue;
		err = denoise_frame(d, &d->set.entries[i]);
		if (!err)
			progress_frame(&progress, d->set.entries[i].frame, "done", progress_clock_s() - start);
	}
	progress_end(&progress);
	return err;
}

int denoise_main(int argc, char **argv)
{
	struct asked asked = { .reach = 3 };
	struct denoising d = { .asked = &asked };
	struct options_line line;
	int err = options_parse(&table, argc, argv, &asked, &line);

	if (!err && (strlen(asked.output) < 4 || strcmp(asked.output + strlen(asked.output) - 4, ".exr") != 0))
		err = err_report(ERR_USAGE, asked.output, "denoised frames are OpenEXR files: the name must end in .exr");
	if (!err && asked.oidn)
		err = oidn_open();
	if (!err)
		err = set_open(line.words[0], &d.set);
	if (!err)
		err = run(&d);
	for (size_t i = 0; i < sizeof(d.kept) / sizeof(d.kept[0]); i++)
		drop(&d.kept[i]);
	set_free(&d.set);
	frame_list_free(&asked.frames);
	return err == 1 ? 0 : -err;
}
