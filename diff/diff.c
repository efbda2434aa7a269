/* relume diff: score traced frames against their references, or any two sets of images. */
#include "diff/diff.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/options.h"
#include "base/part.h"
#include "diff/baseline/baseline.h"
#include "diff/report/junit.h"
#include "diff/report/markdown.h"
#include "diff/report/output.h"
#include "diff/report/report.h"
#include "diff/report/summary.h"
#include "diff/report/table.h"
#include "diff/runs/scoring.h"
#include "diff/score/gates.h"
#include "diff/pictures/match.h"
#include "diff/rules/rules.h"
#include "diff/runs/runs.h"
#include "tracer/image/oiio.h"

struct options {
	const char *reference, *traced, *report, *film, *json, *junit, *config, *baseline;
	const char *markdown, *quarantine;
	unsigned expires;
	int annotations, all, table;
	struct frame_list frames;
	struct score_options score;
};

/** "shadow=1:40": per cent; either bound may be empty. */
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
	return err_report(ERR_USAGE, NULL, "'%s' is not a range of an effect; write shadow=1:40 or any=0.5:", text);
}

static int want_yee(const struct options_row *row, const char *value, void *out)
{
	struct score_options *options = out;

	(void)row, (void)value;
	options->yee = oiio_compare_yee;
	return 0;
}

static const struct options_row rows[] = {
	{ "frames", 'f', "LIST",
	  "frames that must exist and pass, as in 10-60 or 1-500x5 (default: those of TRACED)", options_frames,
	  .at = offsetof(struct options, frames) },
	{ "all", 0, NULL,
	  "every frame of REF, TRACED or the approved frames must exist and pass; with --frames: every "
	  "listed frame that one of them has",
	  options_flag, .at = offsetof(struct options, all) },
	{ "channel", 0, "LAYER",
	  "layer to compare with the reference: gl (default if present), beauty, any layer by the prefix of its channels' "
	  "names (view.diffuse, N), or a single channel (Z)",
	  options_text, .at = offsetof(struct options, score.channel) },
	{ "ignore-alpha", 0, NULL,
	  "ignore alpha and compare colours as stored; by default, pictures from other programs are compared with colours "
	  "multiplied by alpha, and pictures without alpha are opaque",
	  options_flag, .at = offsetof(struct options, score.ignore_alpha) },
	{ "effects", 0, "E=LO:HI",
	  "gate E3: effect E (shadow, relight, reflect, refract, any) must touch LO to HI per cent of the "
	  "pixels; either bound may be omitted; may be repeated",
	  parse_effects, .at = offsetof(struct options, score) },
	{ "baseline", 0, "DIR", "gate B: compare with the frames that 'relume approve' stored in DIR", options_text,
	  .at = offsetof(struct options, baseline), .use = CONFINE_READS },
	{ "config", 0, "FILE",
	  "bars, masks, flaky frames (default: relume-diff.yaml if it exists); 'relume help diff-file' lists its "
	  "keys",
	  options_text, .at = offsetof(struct options, config) },
	{ "yee", 0, NULL, "also measure Yee's metric, which is slow", want_yee,
	  .at = offsetof(struct options, score) },
	{ "report", 0, "DIR", "write DIR/index.html, a page with all pictures in it, and DIR/sheet.png, a contact sheet",
	  options_text, .at = offsetof(struct options, report), .use = CONFINE_FILLS },
	{ "film", 0, "FILM", "include FILM, made by 'relume film', in the report's page",
	  options_text, .at = offsetof(struct options, film), .use = CONFINE_READS },
	{ "table", 0, NULL,
	  "print the full table: a line for each frame, a column for each gate, 170 columns wide (default: what failed, why, "
	  "and what to do)",
	  options_flag, .at = offsetof(struct options, table) },
	{ "json", 0, "FILE", "write every figure and bar as JSON; - writes to standard output, in place of the text",
	  options_text, .at = offsetof(struct options, json), .use = CONFINE_WRITES },
	{ "junit", 0, "FILE", "write JUnit XML, one case for each frame, with the files to look at", options_text,
	  .at = offsetof(struct options, junit), .use = CONFINE_WRITES },
	{ "markdown", 0, "FILE", "write a Markdown summary for a merge request; appended if FILE exists",
	  options_text, .at = offsetof(struct options, markdown), .use = CONFINE_WRITES },
	{ "annotations", 0, NULL, "print workflow commands (::error, ::warning) that CI servers show beside a change",
	  options_flag, .at = offsetof(struct options, annotations) },
	{ "quarantine", 0, "FILE",
	  "with several runs: write proposed entries for flaky frames to FILE (default: standard output)",
	  options_text, .at = offsetof(struct options, quarantine), .use = CONFINE_WRITES },
	{ "expires", 0, "DAYS", "days until proposed entries expire (default 30)", options_number,
	  .at = offsetof(struct options, expires), .most = 3650 },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "diff",
	.head = "usage: relume diff [OPTIONS] REF TRACED\n"
		"       relume diff [OPTIONS] --baseline DIR TRACED\n"
		"       relume diff [OPTIONS] REF RUN RUN...\n"
		"\n"
		"Score traced frames against their references, frame by frame and gate by gate.\n"
		"\n"
		"REF     a trace (NAME.ref beside it holds its frames), a .ref file, or images\n"
		"TRACED  images: those of 'relume render', or any; the gates of effects, depth and harm need its "
	        "OpenEXR files\n"
		"        Images are a folder (the last number in a name is its frame), a pattern such as\n"
		"        out/gears.####.exr, or one file. Pictures without channels gl.* are compared by their "
	        "colours.\n"
		"        Between two folders, pictures without a number and those in subfolders are matched by path:\n"
		"        login.png, dark/login.exr.\n"
		"RUN     the same frames again. With several runs, frames whose failures are noise are distinguished\n"
		"        from regressions: for each pixel, the value nearest to REF within the range of the runs is\n"
		"        used, and a failure that remains is a regression. REF may be approved frames. Entries for\n"
		"        `flaky:` of relume-diff.yaml are proposed, and those no longer needed are listed.\n",
	OPTIONS_ROWS(rows),
	.notes = "Exit codes: 0 all frames passed; 1 a frame failed or is missing; 3 an input cannot be read;\n"
		 "4 there are traced frames without a reference or an approved frame, and all others passed.\n"
		 "With several runs: 0 no regressions, 1 a frame is a regression, 3 an input cannot be read.\n",
	.takes = "REF and TRACED, --baseline DIR and TRACED, or REF and up to 32 runs",
	.least = 1,
	.most = RUNS_MOST + 1,
	.words_use = CONFINE_RECORDING,
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
		return err_report(ERR_USAGE, NULL, "--film needs --report DIR");
	if (o->film && access(o->film, R_OK) != 0)
		return err_report(ERR_INPUT, o->film, "%s", strerror(errno));
	if (line->n_words > 2 && (o->report || o->json || o->junit || o->annotations || o->markdown || o->baseline))
		return err_report(ERR_USAGE, NULL,
		                  "--report, --json, --junit, --markdown, --annotations and --baseline cannot be used when "
		                  "comparing several runs");
	if (line->n_words <= 2 && o->quarantine)
		return err_report(ERR_USAGE, NULL, "--quarantine needs several runs");
	o->reference = line->n_words >= 2 ? line->words[0] : NULL;
	o->traced = line->words[line->n_words - 1];
	return 0;
}

/** Give the blamed draws the names of their calls. Draws that the trace does not name stay unnamed: the scores are
 * valid without. */
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

/** "relume" and all words of the command line, for the page; caller frees; NULL if out of memory. getopt has sorted
 * them. */
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

/** The recording's name, which the globs of a configuration match: the file name without extension. */
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

/** Open the sets, the baseline and the settings. */
static int open_all(struct options *o, const struct options_line *line, struct set *ref, struct set *traced,
                    struct baseline *baseline, struct score_rules **settings)
{
	const char *config = o->config ? o->config : access("relume-diff.yaml", F_OK) == 0 ? "relume-diff.yaml" : NULL;
	int err = config ? score_rules_read(config, settings) : 0;

	if (!err && *settings && !o->baseline)
		o->baseline = score_rules_baseline(*settings);
	if (!err)
		err = options_confine(&table, line, CONFINE_SCORER, o->baseline);
	if (!err && o->reference)
		err = set_open_named(o->reference, ref);
	if (!err)
		err = set_open_named(o->traced, traced);
	if (!err && o->baseline && access(o->baseline, F_OK) != 0)
		err_warn(o->baseline,
		         "no such folder, so all frames are new; create it with 'relume approve TRACED %s'",
		         o->baseline);
	if (!err && o->baseline)
		err = baseline_open(o->baseline, baseline);
	return err;
}

/* Give a single picture without a number that of the only frame it can be compared with. */
static int number_single(const struct options *o, struct set *single, const struct set *other)
{
	struct set_entry *picture = single->is_single ? single->entries : NULL;
	const struct set_entry *same = picture ? set_find(other, picture->frame) : NULL;
	size_t n = 0;

	if (!picture || !picture->name || !other->n_entries || (same && same->name))
		return 0;
	for (size_t i = 0; i < other->n_entries; i++)
		if (frame_list_contains(&o->frames, other->entries[i].frame)) {
			picture->frame = other->entries[i].frame;
			n++;
		}
	if (n == 1)
		return 0;
	return err_report(ERR_USAGE, picture->path,
	                  "has no frame number, and %s has %zu frames to compare it with; name one by -f, or put its number "
	                  "into the file's name",
	                  other->name, n);
}

static int match_all(const struct options *o, struct set *ref, struct set *traced)
{
	struct set *const sets[] = { ref, traced };
	int err;

	/* Two single images are a pair, whatever their names. */
	if (ref->is_single && traced->is_single) {
		ref->entries[0].frame = traced->entries[0].frame;
		return 0;
	}
	err = set_match(sets, 2, o->baseline || !o->reference);
	if (!err)
		err = number_single(o, traced, ref);
	return err ? err : number_single(o, ref, traced);
}

static int write_all(const struct options *o, const struct picture_sources *from)
{
	const struct output_run *run = from->run;
	int err = 0;

	if (o->report)
		err = report_write(from, o->report);
	if (!err && o->json)
		err = output_json(run, o->json);
	if (!err && o->junit)
		err = junit_write(run, o->junit);
	if (!err && o->markdown)
		err = markdown_write(run, o->report, o->markdown);
	if (!err && !(o->json && strcmp(o->json, "-") == 0))
		err = o->table ? table_write(run, stdout) : summary_write(run, o->report, stdout);
	if (!err && o->annotations)
		output_annotations(run, o->json && strcmp(o->json, "-") == 0 ? stderr : stdout);
	return err;
}

/* --- Several runs ------------------------------------------------------------------------------------------------ */

static int tell_runs(const struct options *o, const struct runs *r, const struct runs_frame *frames)
{
	struct part_file file;
	int err = 0;

	runs_table(r, frames, stdout);
	if (o->quarantine) {
		err = part_open(&file, o->quarantine);
		if (!err) {
			fputs("flaky:\n", file.stream);
			runs_quarantine(r, frames, o->expires, file.stream);
			err = part_close(&file, 0);
		}
	} else {
		runs_quarantine(r, frames, o->expires, stdout);
	}
	if (!err)
		err = runs_unneeded(r, stdout);
	for (size_t i = 0; i < r->n_frames && !err; i++)
		err = frames[i].verdict == RUNS_REGRESSION ? ERR_FAILED : 0;
	return err;
}

static int score_runs(const struct options *o, struct runs *r, char **words, const struct score_rules *settings)
{
	static const struct baseline none = { .dir = NULL };
	struct runs_frame *frames = calloc(r->n_frames + 1, sizeof(*frames));
	char names[RUNS_MOST][256];
	int err = frames ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (size_t i = 0; i < r->n && !err; i++) {
		struct output_run *run = &r->runs[i];
		char *name = names[i];

		name_run(r->match ? r->ref->name : words[i], name, sizeof(names[i]));
		*run = (struct output_run){ .reference = r->ref->name,
			                    .traced = words[i],
			                    .name = name,
			                    .command = "",
			                    .options = &o->score,
			                    .ref = r->ref,
			                    .set = &r->sets[i],
			                    .settings = settings,
			                    .n_scores = r->n_frames };
		run->scores = calloc(r->n_frames + 1, sizeof(*run->scores));
		err = run->scores ? scoring_all(r->ref, &r->sets[i], &none, r->frames, run) :
		                    err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	if (!err)
		err = runs_judge(r, frames);
	if (!err)
		err = tell_runs(o, r, frames);
	free(frames);
	return err;
}

static int compare_runs(struct options *o, const struct options_line *line)
{
	static const struct baseline none = { .dir = NULL };
	struct set ref = { 0 }, sets[RUNS_MOST] = { { 0 } };
	const struct set *all[RUNS_MOST + 1] = { &ref };
	struct set *matched[RUNS_MOST + 1] = { &ref };
	struct output_run scored[RUNS_MOST] = { { 0 } };
	struct runs r = { .runs = scored, .n = (size_t)line->n_words - 1, .ref = &ref, .sets = sets };
	struct baseline unused = { 0 };
	struct score_rules *settings = NULL;
	uint64_t *frames = NULL;
	char name[256];
	int err;

	o->traced = line->words[1];
	err = open_all(o, line, &ref, &sets[0], &unused, &settings);
	for (size_t i = 1; i < r.n && !err; i++)
		err = set_open_named(line->words[i + 1], &sets[i]);
	for (size_t i = 0; i < r.n; i++)
		matched[i + 1] = &sets[i];
	if (!err)
		err = set_match(matched, r.n + 1, 0);
	for (size_t i = 0; i < r.n; i++)
		all[i + 1] = &sets[i];
	if (!err)
		err = scoring_list(all, r.n + 1, &none, &(struct scoring_asked){ &o->frames, 1 }, &frames, &r.n_frames);
	if (!err) {
		name_run(ref.trace ? ref.trace : ref.name, name, sizeof(name));
		r.match = ref.trace || ref.ref.stream ? name : NULL;
		r.frames = frames;
		err = score_runs(o, &r, line->words + 1, settings);
	}
	for (size_t i = 0; i < r.n; i++) {
		free(scored[i].scores);
		set_free(&sets[i]);
	}
	free(frames);
	baseline_close(&unused);
	score_rules_free(&settings);
	set_free(&ref);
	return err;
}

/* List the frames to compare, and count those that only --all would add. */
static int list_frames(const struct options *o, const struct set *ref, const struct set *traced,
                       const struct baseline *baseline, uint64_t **frames, struct output_run *run)
{
	const struct set *const sets[] = { ref, traced };
	const struct scoring_asked asked = { &o->frames, o->all };
	uint64_t *all = NULL;
	size_t n_all = 0;
	int err = scoring_list(sets, 2, baseline, &asked, frames, &run->n_scores);

	if (!err && !o->all && !o->frames.n_ranges)
		err = scoring_list(sets, 2, baseline, &(struct scoring_asked){ &o->frames, 1 }, &all, &n_all);
	if (!err && all)
		run->n_unmatched = n_all - run->n_scores;
	free(all);
	return err;
}

/* --- The verb ---------------------------------------------------------------------------------------------------- */

int diff_main(int argc, char **argv, draw_namer *namer)
{
	struct options o = { .expires = 30 };
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
	if (line.n_words > 2) {
		err = compare_runs(&o, &line);
		frame_list_free(&o.frames);
		return -err;
	}
	err = open_all(&o, &line, &ref, &traced, &baseline, &settings);
	if (!err)
		err = match_all(&o, &ref, &traced);
	if (err)
		goto fail;
	err = list_frames(&o, &ref, &traced, &baseline, &frames, &run);
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
	run.ref = &ref;
	run.set = &traced;
	run.settings = settings;

	err = scoring_all(&ref, &traced, &baseline, frames, &run);
	if (!err && ref.trace)
		err = name_blamed_draws(ref.trace, namer, &run);
	if (!err)
		err = write_all(&o, &(struct picture_sources){ &run, &ref, &traced, &baseline });
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
