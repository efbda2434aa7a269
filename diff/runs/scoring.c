/* Lists frames, and scores them in threads. */
#include "diff/runs/scoring.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/err.h"
#include "base/progress.h"
#include "diff/score/gates.h"
#include "diff/score/picture.h"
#include "diff/report/pictures.h"
#include "diff/rules/rules.h"

/* A number beyond this in a list of frames means an open range, not a list of missing frames. */
#define MAX_ASKED 1000000

static int compare_frames(const void *a, const void *b)
{
	uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;

	return (x > y) - (x < y);
}

/* A list of frames being collected. */
struct gathered {
	const struct frame_list *asked;
	uint64_t *frames;
	size_t n;
};

static void gather(struct gathered *g, uint64_t frame)
{
	if (frame_list_contains(g->asked, frame))
		g->frames[g->n++] = frame;
}

static size_t sort_unique(uint64_t *frames, size_t n)
{
	size_t unique = 0;

	qsort(frames, n, sizeof(*frames), compare_frames);
	for (size_t i = 0; i < n; i++)
		if (i == 0 || frames[i] != frames[i - 1])
			frames[unique++] = frames[i];
	return unique;
}

int scoring_list(const struct set *const *sets, size_t n_sets, const struct baseline *baseline,
                 const struct scoring_asked *asked, uint64_t **out, size_t *n_out)
{
	const int is_named = asked->frames->n_ranges && !asked->all;
	/* an open range means the frames that exist */
	const int is_closed = is_named && frame_list_last(asked->frames) < MAX_ASKED;
	const uint64_t last = is_closed ? frame_list_last(asked->frames) + 1 : 0;
	const int everywhere = asked->all || (is_named && !last);
	struct gathered g = { .asked = asked->frames };
	size_t most = (size_t)last + 1;

	for (size_t v = 0; v < baseline->n_variants; v++)
		most += baseline->variants[v]->n_frames;
	for (size_t s = 0; s < n_sets; s++)
		most += sets[s]->n_entries;
	g.frames = calloc(most, sizeof(*g.frames));
	if (!g.frames)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t s = everywhere ? 0 : n_sets - 1; s < n_sets; s++)
		for (size_t i = 0; i < sets[s]->n_entries; i++)
			gather(&g, sets[s]->entries[i].frame);
	for (size_t v = 0; everywhere && v < baseline->n_variants; v++)
		for (uint32_t i = 0; i < baseline->variants[v]->n_frames; i++)
			gather(&g, baseline->variants[v]->frames[i].frame);
	for (uint64_t f = 0; f < last; f++)
		gather(&g, f);
	*n_out = sort_unique(g.frames, g.n);
	if (*n_out == 0) {
		free(g.frames);
		return err_report(ERR_USAGE, NULL, "none of the frames asked for is in %s or %s", sets[0]->name,
		                  sets[n_sets - 1]->name);
	}
	*out = g.frames;
	return 0;
}

/* State shared by the threads. Each takes the next frame; memory grows with threads, not with frames. */
struct work {
	struct scoring all;
	const uint64_t *frames;
	struct output_run *run;

	pthread_mutex_t lock; /* guards all members below */
	struct progress progress;
	size_t next;
	int err;
};

/** Replaces a missing reference: only its size. */
static struct score_picture picture_of_size(const struct image *img)
{
	return (struct score_picture){ .width = img->width, .height = img->height };
}

/** A frame that failed only gates known to be flaky does not fail. */
static void judge_flaky(const struct score_rules_frame *settings, struct score *s)
{
	unsigned failed = 0;

	for (int g = 0; g < N_GATES; g++)
		failed |= s->gates[g].state == SCORE_FAILED ? 1u << g : 0;
	if (s->outcome != SCORE_FRAME_FAILED || !(failed & settings->flaky_gates) || failed & ~settings->flaky_gates)
		return;
	s->outcome = SCORE_FRAME_FLAKY;
	s->flaky_reason = settings->flaky_reason;
}

int scoring_image(const struct scoring *w, uint64_t frame, struct score_picture *picture, const struct image *image,
                  struct score *out)
{
	const struct output_run *run = w->run;
	struct score_rules_frame settings = { 0 };
	struct score_approved approved;
	struct image was = { 0 };
	int found = 0;
	int err = score_rules_for_frame(run->settings, run->name, frame, run->options,
	                                (uint32_t[]){ picture->width, picture->height }, &settings);

	if (!err)
		err = score_rules_ignore_outside(&settings, picture->outside, (size_t)picture->width * picture->height);
	if (!err && image->width == picture->width && image->height == picture->height)
		err = score_rules_ignore_outside(&settings, image->outside, (size_t)image->width * image->height);
	picture->ignore = settings.ignore;
	picture->recording = w->ref->trace_hash;
	if (!err && w->baseline->dir)
		err = baseline_look_up(w->baseline, image, frame, &was, &approved, &found);
	if (!err)
		err = score_frame(picture, image, frame, &settings.options, found ? &approved : NULL, out);
	if (!err) {
		judge_flaky(&settings, out);
		if (out->outcome == SCORE_FRAME_PASSED && w->baseline->dir && !found)
			out->outcome = SCORE_FRAME_NEW;
	}
	score_rules_frame_free(&settings);
	image_free(&was);
	return err;
}

/** 1 if the reference of a frame is lost, as its file ends before it. */
static int is_cut_off(const struct set *ref, uint64_t frame)
{
	return ref->ref.is_cut && frame > ref->entries[ref->n_entries - 1].frame;
}

/** Score one frame, whatever the outcome. @return 0, or ERR_SYSTEM (reported) */
static int score_one(struct work *w, uint64_t frame, struct score *out)
{
	const struct set_entry *r = set_find(w->all.ref, frame), *t = set_find(w->all.traced, frame);
	const int needs_reference = w->run->reference != NULL;
	struct image ref_image = { 0 }, image = { 0 };
	struct score_picture picture = { 0 };
	int err = 0;

	*out = (struct score){ .frame = frame,
		               .outcome = !t                            ? SCORE_FRAME_MISSING :
		                          !r && is_cut_off(w->all.ref, frame) ? SCORE_FRAME_UNREADABLE :
		                                                          SCORE_FRAME_EXTRA };
	if (!t || (!r && needs_reference))
		return 0;
	if (r)
		err = set_read(w->all.ref, r, &ref_image);
	if (!err && r)
		err = picture_take_reference(&ref_image, w->run->options->channel, &picture);
	if (err == ERR_INPUT && ref_image.n_channels)
		err_report(ERR_INPUT, r->path ? r->path : w->all.ref->name, "the reference has no %s",
		           w->run->options->channel ? "such layer (--channel)" : "colour channels");
	if (!err)
		err = set_read(w->all.traced, t, &image);
	if (!err && !r)
		picture = picture_of_size(&image);
	if (!err)
		err = scoring_image(&w->all, frame, &picture, &image, out);
	if (err == ERR_INPUT) {
		out->outcome = SCORE_FRAME_UNREADABLE;
		err = 0;
	}
	score_picture_free(&picture);
	image_free(&image);
	image_free(&ref_image);
	return err;
}

static void *score_frames(void *arg)
{
	struct work *w = arg;

	pthread_mutex_lock(&w->lock);
	while (!w->err && w->next < w->run->n_scores) {
		size_t i = w->next++;
		struct score *s = &w->run->scores[i];
		int err;

		pthread_mutex_unlock(&w->lock);
		err = score_one(w, w->frames[i], s);
		pthread_mutex_lock(&w->lock);
		if (err)
			w->err = err;
		w->run->counts[s->outcome]++;
		progress_step(&w->progress, w->frames[i], "");
	}
	pthread_mutex_unlock(&w->lock);
	return NULL;
}

static int has_layer(const struct image *img, const char *layer, int is_reference)
{
	struct score_picture picture = { 0 };
	const float *planes[3];
	int err;

	if (!is_reference)
		return score_find_layer(img, layer, planes);
	err = picture_take_reference(img, layer, &picture);
	score_picture_free(&picture);
	return err != ERR_INPUT;
}

/* Check that some frame of a set has the layer of --channel. Files that cannot be read are reported later, when they
 * are scored. @return 0 or ERR_USAGE (reported, with the layers of the first frame) */
static int check_layer(const struct set *set, int is_reference, const uint64_t *frames, const struct output_run *run)
{
	const char *layer = run->options->channel;
	char layers[200] = "";
	int found = 0, quiet = 1;

	err_share(&quiet);
	for (size_t i = 0; i < run->n_scores && !found; i++) {
		const struct set_entry *entry = set_find(set, frames[i]);
		struct image img = { 0 };

		if (!entry || set_read(set, entry, &img))
			continue;
		found = has_layer(&img, layer, is_reference);
		if (!found && !*layers)
			score_list_layers(&img, layers, sizeof(layers));
		image_free(&img);
	}
	err_share(NULL);
	return found || !*layers ? 0 : err_report(ERR_USAGE, set->name, "there is no layer '%s'; --channel may be %s", layer,
	                                          layers);
}

int scoring_all(struct set *ref, struct set *traced, const struct baseline *baseline, const uint64_t *frames,
                struct output_run *run)
{
	enum { MAX_THREADS = 16 };
	struct work w = { .all = { ref, traced, baseline, run }, .frames = frames, .run = run,
	                  .lock = PTHREAD_MUTEX_INITIALIZER };
	pthread_t threads[MAX_THREADS];
	long cores = sysconf(_SC_NPROCESSORS_ONLN);
	int n = 0;

	if (run->options->channel) {
		w.err = check_layer(traced, 0, frames, run);
		if (!w.err)
			w.err = check_layer(ref, 1, frames, run);
		if (w.err)
			return w.err;
	}
	/* frames take milliseconds, and important messages come at the end */
	progress_begin_style(&w.progress, "scored", run->n_scores, isatty(STDERR_FILENO) ? PROGRESS_BAR : PROGRESS_NONE);
	/* this thread works as well; if another does not start, only time is lost */
	while (n < MAX_THREADS && n + 1 < cores && (size_t)n + 1 < run->n_scores &&
	       pthread_create(&threads[n], NULL, score_frames, &w) == 0)
		n++;
	score_frames(&w);
	while (n > 0)
		pthread_join(threads[--n], NULL);
	progress_end(&w.progress);
	run->seconds = progress_clock_s() - w.progress.start_s;
	return w.err;
}
