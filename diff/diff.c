/* relume diff: score traced frames against their references, or any two sets of images. */
#include "diff/diff.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/options.h"
#include "base/progress.h"
#include "diff/baseline/baseline.h"
#include "diff/report/output.h"
#include "diff/report/pictures.h"
#include "diff/report/report.h"
#include "diff/score/gates.h"
#include "diff/score/picture.h"
#include "diff/pictures/set.h"
#include "diff/rules/rules.h"
#include "tracer/image/oiio.h"

/* More frames asked for by number than anybody has: a slip of the finger, not a list of missing ones. */
#define MAX_ASKED 1000000

struct options {
	const char *reference, *traced, *report, *film, *json, *junit, *config, *baseline;
	int annotations;
	struct frame_list frames;
	struct score_options score;
};

/** "shadow=1:40": per cent, either bound may be empty. */
static int parse_effects(const struct options_row *row, const char *text, void *out)
{
	struct score_options *options = out;
	const char *equals = strchr(text, '='), *colon = equals ? strchr(equals, ':') : NULL;
	struct score_range range = { N_SCORE_EFFECTS, NAN, NAN };
	char *end;

	for (int e = 0; equals && e < N_SCORE_EFFECTS; e++)
		if (strlen(score_effect_names[e]) == (size_t)(equals - text) &&
		    strncmp(text, score_effect_names[e], (size_t)(equals - text)) == 0)
			range.effect = (enum score_effect)e;
	if (!colon || range.effect == N_SCORE_EFFECTS)
		goto wrong;
	if (colon > equals + 1) {
		range.low = strtod(equals + 1, &end) / 100;
		if (end != colon)
			goto wrong;
	}
	if (colon[1]) {
		range.high = strtod(colon + 1, &end) / 100;
		if (*end)
			goto wrong;
	}
	if (options->n_ranges == SCORE_MAX_RANGES)
		return err_report(ERR_USAGE, NULL, "--%s may be given %d times", row->name, SCORE_MAX_RANGES);
	options->ranges[options->n_ranges++] = range;
	return 0;
wrong:
	return err_report(ERR_USAGE, NULL, "'%s' is no range of an effect; write shadow=1:40 or any=0.5:", text);
}

static int want_yee(const struct options_row *row, const char *value, void *out)
{
	struct score_options *options = out;

	(void)row, (void)value;
	options->yee = oiio_compare_yee;
	return 0;
}

static const struct options_row rows[] = {
	{ "frames", 'f', "LIST", "frames that must be there and pass, as in 10-60 or 1-500x5 (default: all of both sets)",
	  options_frames, .at = offsetof(struct options, frames) },
	{ "channel", 0, "LAYER", "what to compare with the reference: gl (default where there is one), beauty, albedo, ...",
	  options_text, .at = offsetof(struct options, score.channel) },
	{ "effects", 0, "E=LO:HI", "gate E3: effect E (shadow, relight, reflect, refract, any) must touch LO to HI per cent of the "
	  "pixels; either may be left out; may be given several times", parse_effects, .at = offsetof(struct options, score) },
	{ "baseline", 0, "DIR", "gate B: compare with the frames that 'relume approve' put there",
	  options_text, .at = offsetof(struct options, baseline), .use = CONFINE_READS },
	{ "config", 0, "FILE", "bars, masks, flaky frames (default: relume-diff.yaml where there is one)",
	  options_text, .at = offsetof(struct options, config) },
	{ "yee", 0, NULL, "measure Yee's metric as well, which is slow", want_yee, .at = offsetof(struct options, score) },
	{ "report", 0, "DIR", "DIR/index.html, one file with all pictures in it, and DIR/sheet.png, a contact sheet",
	  options_text, .at = offsetof(struct options, report), .use = CONFINE_FILLS },
	{ "film", 0, "FILM", "a film of 'relume film' that the report's page plays; it becomes part of the page",
	  options_text, .at = offsetof(struct options, film), .use = CONFINE_READS },
	{ "json", 0, "FILE", "every figure and bar as JSON; - for standard output, instead of the table",
	  options_text, .at = offsetof(struct options, json), .use = CONFINE_WRITES },
	{ "junit", 0, "FILE", "JUnit XML, one case for each frame", options_text, .at = offsetof(struct options, junit), .use = CONFINE_WRITES },
	{ "annotations", 0, NULL, "print workflow commands (::error, ::warning) that CI servers show beside a change",
	  options_flag, .at = offsetof(struct options, annotations) },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "diff",
	.head = "usage: relume diff [OPTIONS] REF TRACED\n"
	        "       relume diff [OPTIONS] --baseline DIR TRACED\n"
	        "\n"
	        "Score traced frames against their references, frame by frame and gate by gate.\n"
	        "\n"
	        "REF     a trace (NAME.ref beside it holds its frames), a .ref file, or images\n"
	        "TRACED  images: those of 'relume render', or any; the gates of effects, depth and harm need its OpenEXR files\n"
	        "        Images are a folder (the last number in a name is its frame), a pattern such as\n"
	        "        out/gears.####.exr, or one file. Pictures without channels gl.* are compared by their colours.\n",
	OPTIONS_ROWS(rows),
	.notes = "Exit codes: 0 all frames passed; 1 a frame failed or is missing; 3 an input cannot be read;\n"
	         "4 there are traced frames without a reference or an approved frame, and all others passed.\n",
	.takes = "REF and TRACED, or --baseline DIR and TRACED", .least = 1, .most = 2, .words_use = CONFINE_RECORDING,
};

/** @return 0 go on, 1 help was printed, or ERR_* (reported) */
static int parse_options(int argc, char **argv, struct options *o, struct options_line *line)
{
	int err = options_parse(&table, argc, argv, o, line);

	if (err)
		return err;
	if (line->n_words == 1 && !o->baseline)
		return options_misuse(&table);
	if (o->film && !o->report)
		return err_report(ERR_USAGE, NULL, "--film is for the page of --report DIR");
	if (o->film && access(o->film, R_OK) != 0)
		return err_report(ERR_INPUT, o->film, "%s", strerror(errno));
	o->reference = line->n_words == 2 ? line->words[0] : NULL;
	o->traced = line->words[line->n_words - 1];
	return 0;
}

static int compare_frames(const void *a, const void *b)
{
	uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;

	return (x > y) - (x < y);
}

/** All frames to score: of those asked for, the ones in either set or the baseline, and those asked for by number that none has. */
static int list_frames(const struct set *ref, const struct set *traced, const struct baseline *baseline,
                       const struct frame_list *asked, uint64_t **out, size_t *n_out)
{
	const struct set *sets[2] = { ref, traced };
	uint64_t n_asked = asked->n_ranges && frame_list_last(asked) < MAX_ASKED
		? frame_list_count(asked, frame_list_last(asked) + 1) : 0;
	size_t n = 0, unique = 0, n_approved = 0;
	uint64_t *frames;

	for (size_t v = 0; v < baseline->n_variants; v++)
		n_approved += baseline->variants[v]->n_frames;
	frames = calloc(ref->n_entries + traced->n_entries + n_approved + n_asked + 1, sizeof(*frames));
	if (!frames)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (int s = 0; s < 2; s++)
		for (size_t i = 0; i < sets[s]->n_entries; i++)
			if (frame_list_contains(asked, sets[s]->entries[i].frame))
				frames[n++] = sets[s]->entries[i].frame;
	for (size_t v = 0; v < baseline->n_variants; v++)
		for (uint32_t i = 0; i < baseline->variants[v]->n_frames; i++)
			if (frame_list_contains(asked, baseline->variants[v]->frames[i].frame))
				frames[n++] = baseline->variants[v]->frames[i].frame;
	for (uint64_t f = 0; n_asked && f <= frame_list_last(asked); f++)
		if (frame_list_contains(asked, f))
			frames[n++] = f;
	qsort(frames, n, sizeof(*frames), compare_frames);
	for (size_t i = 0; i < n; i++)
		if (i == 0 || frames[i] != frames[i - 1])
			frames[unique++] = frames[i];
	if (unique == 0) {
		free(frames);
		return err_report(ERR_USAGE, NULL, "none of the frames asked for is in %s or %s", ref->name, traced->name);
	}
	*out = frames;
	*n_out = unique;
	return 0;
}

/* What the threads share. Each takes the next frame; memory grows with threads, not with frames. */
struct work {
	struct set *ref, *traced;
	const struct baseline *baseline;
	const uint64_t *frames;
	struct output_run *run;

	pthread_mutex_t lock; /* over all below */
	struct progress progress;
	size_t next;
	int err;
};

/** Stands in for a reference where there is none: the size alone. */
static struct score_picture picture_of_size(const struct image *img)
{
	return (struct score_picture){ .width = img->width, .height = img->height };
}

/** A frame that failed only gates known to be flaky is no failure. */
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

/** Score an image that is there, against a reference (NULL: none), an approved frame, or both. */
static int score_image(struct work *w, uint64_t frame, struct score_picture *picture, const struct image *image,
                       struct score *out)
{
	const struct output_run *run = w->run;
	struct score_rules_frame settings = { 0 };
	struct score_approved approved;
	struct image was = { 0 };
	int found = 0;
	int err = score_rules_for_frame(run->settings, run->name, frame, run->options,
	                                (uint32_t[]){ picture->width, picture->height }, &settings);

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

/** Score one frame, whatever became of it. @return 0, or ERR_SYSTEM (reported) */
static int score_one(struct work *w, uint64_t frame, struct score *out)
{
	const struct set_entry *r = set_find(w->ref, frame), *t = set_find(w->traced, frame);
	const int needs_reference = w->run->reference != NULL;
	struct image ref_image = { 0 }, image = { 0 };
	struct score_picture picture = { 0 };
	int err = 0;

	*out = (struct score){ .frame = frame, .outcome = !t ? SCORE_FRAME_MISSING : SCORE_FRAME_EXTRA };
	if (!t || (!r && needs_reference))
		return 0;
	if (r)
		err = set_read(w->ref, r, &ref_image);
	if (!err && r)
		err = picture_take_reference(&ref_image, w->run->options->channel, &picture);
	if (err == ERR_INPUT && ref_image.n_channels)
		err_report(ERR_INPUT, r->path ? r->path : w->ref->name, "the reference has no colour channels");
	if (!err)
		err = set_read(w->traced, t, &image);
	if (!err && !r)
		picture = picture_of_size(&image);
	if (!err)
		err = score_image(w, frame, &picture, &image, out);
	if (err == ERR_INPUT) {
		out->outcome = SCORE_FRAME_UNREADABLE;
		err = 0;
	}
	score_picture_free(&picture);
	image_free(&image);
	image_free(&ref_image);
	return err;
}

/** "failed (R4, R5), fidelity 99.912 %" */
static void say_outcome(const struct score *s, int has_fidelity, char *text, size_t size)
{
	size_t n = (size_t)snprintf(text, size, "%s", score_outcome_names[s->outcome]), n_failed = 0;

	for (int g = 0; g < N_GATES && n < size; g++)
		if (s->gates[g].state == SCORE_FAILED)
			n += (size_t)snprintf(text + n, size - n, "%s%s", n_failed++ ? ", " : " (", score_gates[g].name);
	if (n < size)
		n += (size_t)snprintf(text + n, size - n, "%s", n_failed ? ")" : "");
	if (has_fidelity && n < size)
		snprintf(text + n, size - n, ", fidelity %.3f %%", 100 * s->fidelity);
}

static void *score_frames(void *arg)
{
	struct work *w = arg;

	pthread_mutex_lock(&w->lock);
	while (!w->err && w->next < w->run->n_scores) {
		size_t i = w->next++;
		struct score *s = &w->run->scores[i];
		char text[128];
		int err;

		pthread_mutex_unlock(&w->lock);
		err = score_one(w, w->frames[i], s);
		say_outcome(s, w->run->reference != NULL, text, sizeof(text));
		pthread_mutex_lock(&w->lock);
		if (err)
			w->err = err;
		w->run->counts[s->outcome]++;
		progress_step(&w->progress, w->frames[i], text);
	}
	pthread_mutex_unlock(&w->lock);
	return NULL;
}

static int score_all(struct set *ref, struct set *traced, const struct baseline *baseline, const uint64_t *frames,
                     struct output_run *run)
{
	enum { MAX_THREADS = 16 };
	struct work w = { .ref = ref, .traced = traced, .baseline = baseline, .frames = frames, .run = run,
	                  .lock = PTHREAD_MUTEX_INITIALIZER };
	pthread_t threads[MAX_THREADS];
	long cores = sysconf(_SC_NPROCESSORS_ONLN);
	int n = 0;

	progress_begin(&w.progress, "scored", run->n_scores);
	/* this thread works, too; one that does not start is no loss but time */
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

/** Give the blamed draws their calls' names. What the trace does not tell stays unnamed: the scores stand without it. */
static int name_blamed_draws(const char *trace, draw_namer *namer, struct output_run *run)
{
	struct draw_name *names = calloc(run->n_scores * SCORE_MAX_BLAME, sizeof(*names));
	size_t n = 0;

	if (!names)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; i < run->n_scores; i++)
		for (uint32_t b = 0; b < run->scores[i].n_blame; b++)
			names[n++] = (struct draw_name){ .frame = run->scores[i].frame, .draw = run->scores[i].blame[b].draw };
	namer(trace, names, n);
	n = 0;
	for (size_t i = 0; i < run->n_scores; i++)
		for (uint32_t b = 0; b < run->scores[i].n_blame; b++)
			run->scores[i].blame[b].name = names[n++];
	free(names);
	return 0;
}

/** "relume" and all words of the verb, for the page; the caller's, NULL without memory. getopt has sorted the words. */
static char *join_command(int argc, char **argv)
{
	size_t size = sizeof("relume");
	char *text;

	for (int i = 0; i < argc; i++)
		size += strlen(argv[i]) + 1;
	text = malloc(size);
	if (!text)
		return NULL;
	strcpy(text, "relume");
	for (int i = 0; i < argc; i++)
		strcat(strcat(text, " "), argv[i]);
	return text;
}

/** The recording's name, which the globs of a configuration match: the file without folder and extension. */
static void name_run(const char *path, char *out, size_t size)
{
	size_t n = strlen(path);
	const char *name;

	while (n > 1 && path[n - 1] == '/')
		n--;
	for (name = path + n; name > path && name[-1] != '/'; name--)
		;
	snprintf(out, size, "%.*s", (int)(path + n - name), name);
	if (strrchr(out, '.') && strrchr(out, '.') != out)
		*strrchr(out, '.') = '\0';
}

static int exit_code(const struct output_run *run)
{
	if (run->counts[SCORE_FRAME_UNREADABLE])
		return -ERR_INPUT;
	if (run->counts[SCORE_FRAME_FAILED] || run->counts[SCORE_FRAME_MISSING])
		return -ERR_FAILED;
	if (run->counts[SCORE_FRAME_EXTRA] || run->counts[SCORE_FRAME_NEW])
		return -ERR_BASELINE;
	return 0;
}

/** Everything that is compared, and how. */
static int open_all(struct options *o, const struct options_line *line, struct set *ref, struct set *traced, struct baseline *baseline,
                    struct score_rules **settings)
{
	const char *config = o->config ? o->config : access("relume-diff.yaml", F_OK) == 0 ? "relume-diff.yaml" : NULL;
	int err = config ? score_rules_read(config, settings) : 0;

	if (!err && *settings && !o->baseline)
		o->baseline = score_rules_baseline(*settings);
	if (!err)
		options_confine(&table, line, CONFINE_READER, o->baseline);
	if (!err && o->reference)
		err = set_open(o->reference, ref);
	if (!err)
		err = set_open(o->traced, traced);
	if (!err && o->baseline)
		err = baseline_open(o->baseline, baseline);
	/* Two single images are a pair whatever their numbers. */
	if (!err && ref->is_single && traced->is_single)
		ref->entries[0].frame = traced->entries[0].frame;
	return err;
}

static int write_all(const struct options *o, const struct output_run *run, struct set *ref, struct set *traced)
{
	int err = 0;

	if (o->report)
		err = report_write(run, ref, traced, o->report);
	if (!err && o->json)
		err = output_json(run, o->json);
	if (!err && o->junit)
		err = output_junit(run, o->junit);
	if (!err && !(o->json && strcmp(o->json, "-") == 0))
		output_table(run, stdout);
	if (!err && o->annotations)
		output_annotations(run, o->json && strcmp(o->json, "-") == 0 ? stderr : stdout);
	return err;
}

int diff_main(int argc, char **argv, draw_namer *namer)
{
	struct options o = { 0 };
	struct options_line line;
	struct set ref = { 0 }, traced = { 0 };
	struct baseline baseline = { 0 };
	struct score_rules *settings = NULL;
	struct output_run run = { 0 };
	char name[256], *command = NULL;
	uint64_t *frames = NULL;
	int err = parse_options(argc, argv, &o, &line), code = 0;

	if (err) {
		frame_list_free(&o.frames);
		return err > 0 ? 0 : -err;
	}
	err = open_all(&o, &line, &ref, &traced, &baseline, &settings);
	if (err)
		goto fail;
	err = list_frames(&ref, &traced, &baseline, &o.frames, &frames, &run.n_scores);
	if (err)
		goto fail;
	run.scores = calloc(run.n_scores, sizeof(*run.scores));
	command = join_command(argc, argv);
	if (!run.scores || !command) {
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
		goto fail;
	}
	name_run(ref.trace ? ref.trace : ref.ref.stream ? ref.name : o.traced, name, sizeof(name));
	run.reference = o.reference ? ref.name : NULL;
	run.traced = o.traced;
	run.baseline = o.baseline;
	run.name = name;
	run.command = command;
	run.film = o.film;
	run.options = &o.score;
	run.settings = settings;

	err = score_all(&ref, &traced, &baseline, frames, &run);
	if (!err && ref.trace)
		err = name_blamed_draws(ref.trace, namer, &run);
	if (!err)
		err = write_all(&o, &run, &ref, &traced);
	code = exit_code(&run);
fail:
	free(run.scores);
	free(command);
	free(frames);
	baseline_close(&baseline);
	score_rules_free(&settings);
	set_free(&traced);
	set_free(&ref);
	frame_list_free(&o.frames);
	return err ? -err : code;
}
