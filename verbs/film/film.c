/* relume film: makes a film of rendered frames, beside the program's own pictures. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/frames.h"
#include "base/options.h"
#include "base/part.h"
#include "base/plural.h"
#include "base/progress.h"
#include "base/verbs.h"
#include "diff/pictures/set.h"
#include "tracer/image/display.h"
#include "verbs/film/encoder.h"
#include "verbs/film/layout.h"
#include "verbs/film/matroska.h"
#include "verbs/film/rate.h"

#define LONGEST_S 2.0 /* longest time that a frame is shown: longer pauses, such as loading, are cut */
#define POSTER_QUALITY 90

struct asked {
	const char *frames_of, *output, *raster;
	struct frame_list frames;
	unsigned fps;
	struct layout layout;
	struct display_options display;
};

static const struct options_row rows[] = {
	{ "output", 'o', "FILM",
	  "the film's file: .webm, .mp4 or .mkv; a poster appears beside it, as FILM with the ending .jpg",
	  options_text, .at = offsetof(struct asked, output), .is_required = 1 },
	{ "frames", 'f', "LIST", "frames to show (default: all that exist)", options_frames,
	  .at = offsetof(struct asked, frames) },
	{ "layout", 0, "WORD",
	  "side: the program's picture beside the traced one (default); wipe: a line moves between the two; "
	  "alternate: one after the other; traced or raster: one alone",
	  options_word, .at = offsetof(struct asked, layout.kind), .words = layout_names },
	{ "raster", 0, "REF",
	  "the program's pictures: a trace (with NAME.ref beside it), a .ref file or images (default: the frames' "
	  "channels gl.*)",
	  options_text, .at = offsetof(struct asked, raster) },
	{ "fps", 0, "N",
	  "show N frames a second (default: each as long as the program showed it, but at least for one of the 30 or 60 "
	  "pictures that a second has, and at most 2 s; 30 a second where the frames do not tell)",
	  options_number, .at = offsetof(struct asked, fps), .most = 240 },
	{ "caption", 0, "TEXT", "a line below the pictures", options_text,
	  .at = offsetof(struct asked, layout.caption) },
	{ "no-labels", 0, NULL, "do not label the pictures", options_flag,
	  .at = offsetof(struct asked, layout.no_labels) },
	{ "exposure", 0, "STOPS", "make the traced picture brighter by this many stops (default 0)", options_real,
	  .at = offsetof(struct asked, display.exposure), .low = -30, .high = 30 },
	{ "white", 0, "X",
	  "the brightness that is shown as white, as for 'relume render' (default: as the frames' mode has it)",
	  options_real, .at = offsetof(struct asked, display.white), .low = 1, .high = 10000 },
};

static const struct options_table table = {
	.verb = "film",
	.head = "usage: relume film [OPTIONS] FRAMES -o FILM\n"
		"\n"
		"Make a film of rendered frames, beside the program's own pictures.\n"
		"\n"
		"FRAMES  made by 'relume render': a folder, or a pattern such as out/gears.####.exr. OpenEXR frames "
	        "hold both\n"
		"        pictures; .png and .jpg need --raster\n",
	OPTIONS_ROWS(rows),
	.notes = "ffmpeg, which must be installed, encodes the film.\n"
		 "Exit codes: 0 done, 2 wrong usage, 3 a frame cannot be read, 5 ffmpeg or the system failed.\n",
	.takes = "FRAMES and -o FILM",
	.least = 1,
	.most = 1,
};

/* The film so far. */
struct film {
	const struct asked *asked;
	struct layout layout;
	struct set traced, raster;             /* raster: empty if the frames have their own */
	struct display *of_traced, *of_raster; /* NULL: no frame read yet */
	uint32_t width, height;                /* size of the frames */
	struct oiio_pixels picture;            /* one picture of the film */
	struct encoder *encoder;
	unsigned fps;
	uint64_t n_pictures;                   /* in the film so far */
	/* The held frame: shown as soon as its duration is known. */
	uint8_t *raster_rgb, *traced_rgb;
	uint64_t time_ns;                      /* when the program showed it; 0: not known */
	double ends_s, lasts_s;                /* its end in the film; the duration of the last one */
	double shown_s;                        /* time that the program showed all frames that the film shows longer */
	uint64_t n_slowed;                     /* number of these frames */
	int is_held;
};

/* --- Frames ------------------------------------------------------------------------------------------------------ */

static int fill(struct film *f, const struct display *display, const struct image *img, const char *layer,
                const char *where, uint8_t *rgb)
{
	if (img->width != f->width || img->height != f->height)
		return err_report(ERR_INPUT, where, "is %u x %u pixels, but the film started at %u x %u", img->width,
		                  img->height, f->width, f->height);
	if (*layer && !image_channel(img, "gl.R"))
		return err_report(ERR_INPUT, where, "holds no channels gl.*; name the recording or its raster frames with --raster");
	return display_codes(display, img, layer, rgb, NULL);
}

/* How the film is to be seen: as its frames are, if it shows nothing else. Their strip of labels is left out then. */
static struct matroska_view choose_view(struct film *f, const struct image *img)
{
	const char *projection = image_attribute(img, "relume:projection"), *eyes = image_attribute(img, "relume:eyes");
	const int is_panorama = projection && strcmp(projection, "panorama") == 0;
	struct matroska_view view = { MATROSKA_MONO, is_panorama };

	if (eyes)
		view.stereo = strcmp(eyes, "side by side") == 0 ? MATROSKA_SIDE_BY_SIDE : MATROSKA_TOP_BOTTOM;
	if (!is_panorama && !eyes)
		return view;
	if (f->layout.kind == LAYOUT_TRACED && !f->layout.caption) {
		f->layout.no_labels = 1;
		return view;
	}
	err_warn(f->traced.name, "players will not show the film as a panorama or for two eyes, as it shows more; "
	                         "--layout traced without --caption does not");
	return (struct matroska_view){ MATROSKA_MONO, 0 };
}

/* The first frame determines size, view, tone curve and speed. */
static int begin(struct film *f, const struct image *img)
{
	const char *white = image_attribute(img, "relume:white");
	const struct matroska_view view = choose_view(f, img);
	struct display_options traced = f->asked->display;
	size_t bytes;
	int err;

	if (!(traced.white > 0))
		traced.white = white && strtof(white, NULL) >= 1 ? strtof(white, NULL) : 1;
	err = display_create(&traced, &f->of_traced);
	if (!err)
		err = display_create(&(struct display_options){ .white = 1, .rounds = 1 }, &f->of_raster);
	if (err)
		return err;
	f->width = img->width;
	f->height = img->height;
	layout_size(&f->layout, f->width, f->height, &f->picture.width, &f->picture.height);
	bytes = (size_t)f->width * f->height * 3;
	f->raster_rgb = malloc(bytes);
	f->traced_rgb = malloc(bytes);
	f->picture.rgb = malloc((size_t)f->picture.width * f->picture.height * 3);
	if (!f->raster_rgb || !f->traced_rgb || !f->picture.rgb)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	err = folder_make_for(f->asked->output);
	return err ? err : encoder_open(f->asked->output, f->picture.width, f->picture.height, f->fps, &view,
	                                &f->encoder);
}

/* Show the held frame until `f->ends_s`. */
static int show(struct film *f)
{
	const uint64_t rounded = (uint64_t)(f->ends_s * f->fps + 0.5);
	const uint64_t end = rounded > f->n_pictures ? rounded : f->n_pictures + 1; /* each frame is seen */
	int err = 0;

	for (uint64_t first = f->n_pictures; f->n_pictures < end && !err; f->n_pictures++) {
		if (f->n_pictures == first || layout_moves(f->layout.kind))
			layout_draw(&f->layout, f->raster_rgb, f->traced_rgb, f->width, f->height,
			            (double)f->n_pictures / f->fps, &f->picture);
		err = encoder_write(f->encoder, f->picture.rgb);
	}
	return err;
}

/* Duration of the held frame, in seconds. @param next_ns  time of the next one; 0: not known, or there is none */
static double duration(const struct film *f, uint64_t next_ns)
{
	if (f->asked->fps)
		return 1.0 / f->asked->fps;
	if (f->time_ns && next_ns > f->time_ns)
		return fmin((double)(next_ns - f->time_ns) / 1e9, LONGEST_S);
	return f->lasts_s > 0 ? f->lasts_s : 1.0 / RATE_FPS;
}

/* The held frame has ended: show it. */
static int let_go(struct film *f, uint64_t next_ns)
{
	if (!f->is_held)
		return 0;
	f->lasts_s = duration(f, next_ns);
	if (f->lasts_s < 0.99 / f->fps) {
		f->shown_s += f->lasts_s;
		f->n_slowed++;
		f->lasts_s = 1.0 / f->fps;
	}
	f->ends_s += f->lasts_s;
	return show(f);
}

static int take_frame(struct film *f, const struct set_entry *entry)
{
	const enum layout_kind kind = f->layout.kind;
	const struct set_entry *other = f->asked->raster ? set_find(&f->raster, entry->frame) : entry;
	const char *where = entry->path ? entry->path : f->traced.name;
	struct image img = { .width = 0 }, shown = { .width = 0 };
	uint64_t time_ns;
	int err = set_read(&f->traced, entry, &img);

	if (!err && !f->encoder)
		err = begin(f, &img);
	time_ns = err ? 0 : rate_time_ns(&img);
	if (!err)
		err = let_go(f, time_ns);
	if (!err && layout_wants_traced(kind))
		err = fill(f, f->of_traced, &img, "", where, f->traced_rgb);
	if (!err && layout_wants_raster(kind) && f->asked->raster) {
		err = other ? set_read(&f->raster, other, &shown)
		            : err_report(ERR_INPUT, f->raster.name, "has no frame %" PRIu64, entry->frame);
		if (!err)
			err = fill(f, f->of_raster, &shown, "", f->raster.name, f->raster_rgb);
	} else if (!err && layout_wants_raster(kind)) {
		err = fill(f, f->of_raster, &img, "gl.", where, f->raster_rgb);
	}
	f->time_ns = time_ns;
	f->is_held = 1;
	image_free(&img);
	image_free(&shown);
	return err;
}

/* --- The poster -------------------------------------------------------------------------------------------------- */

/* The film's picture of the held frame; both halves if they alternate. */
static int write_poster(struct film *f)
{
	struct layout layout = f->layout;
	const size_t stem = (size_t)(strrchr(f->asked->output, '.') - f->asked->output);
	char path[4096];

	if (layout.kind == LAYOUT_ALTERNATE)
		layout.kind = LAYOUT_WIPE;
	layout_draw(&layout, f->raster_rgb, f->traced_rgb, f->width, f->height, 0, &f->picture);
	if (snprintf(path, sizeof(path), "%.*s.jpg", (int)stem, f->asked->output) >= (int)sizeof(path))
		return err_report(ERR_USAGE, f->asked->output, "the name is too long");
	return display_save(&f->picture, &(struct oiio_coding){ "jpg", .quality = POSTER_QUALITY }, path);
}

/* --- All together ------------------------------------------------------------------------------------------------ */

static uint64_t count_frames(const struct film *f)
{
	uint64_t n = 0;

	for (size_t i = 0; i < f->traced.n_entries; i++)
		n += frame_list_contains(&f->asked->frames, f->traced.entries[i].frame) != 0;
	return n;
}

static int run(struct film *f)
{
	const uint64_t total = count_frames(f);
	struct progress progress;
	uint64_t n = 0;
	int err = total ? 0 : err_report(ERR_INPUT, f->traced.name, "holds none of the frames asked for");

	if (err)
		return err;
	f->fps = f->asked->fps;
	if (!f->fps)
		err = rate_choose(&f->traced, &f->asked->frames, &f->fps);
	if (err)
		return err;
	part_sweep(f->asked->output);
	progress_begin(&progress, "filmed", total);
	for (size_t i = 0; i < f->traced.n_entries && !err; i++) {
		const double start = progress_clock_s();

		if (!frame_list_contains(&f->asked->frames, f->traced.entries[i].frame))
			continue;
		err = take_frame(f, &f->traced.entries[i]);
		if (!err && n++ == total / 2)
			err = write_poster(f);
		if (!err)
			progress_frame(&progress, f->traced.entries[i].frame, "done", progress_clock_s() - start);
	}
	if (!err)
		err = let_go(f, 0);
	err = encoder_close(&f->encoder, err);
	progress_end(&progress);
	if (!err)
		fprintf(stderr, "%s: %" PRIu64 " frame%s, %.1f s, %u x %u\n", f->asked->output, total, plural(total),
		        (double)f->n_pictures / f->fps, f->picture.width, f->picture.height);
	if (!err && f->n_slowed)
		fprintf(stderr,
		        "  the program showed %" PRIu64
		        " of these frames in %.2g s, faster than films go: each is shown for one picture "
		        "(--fps sets how many a second)\n",
		        f->n_slowed, f->shown_s);
	return err;
}

static int make_film(const struct asked *asked)
{
	struct film f = { .asked = asked, .layout = asked->layout };
	int err = encoder_knows(asked->output) ? set_open(asked->frames_of, &f.traced) : ERR_USAGE;

	if (!err && asked->raster)
		err = set_open(asked->raster, &f.raster);
	if (!err)
		err = run(&f);
	set_free(&f.traced);
	set_free(&f.raster);
	display_destroy(&f.of_traced);
	display_destroy(&f.of_raster);
	free(f.raster_rgb);
	free(f.traced_rgb);
	free(f.picture.rgb);
	return err;
}

int film_main(int argc, char **argv)
{
	struct asked asked = { .output = NULL };
	struct options_line line;
	int err = options_parse(&table, argc, argv, &asked, &line);

	if (!err) {
		asked.frames_of = line.words[0];
		err = make_film(&asked);
	}
	frame_list_free(&asked.frames);
	return err == 1 ? 0 : -err;
}
