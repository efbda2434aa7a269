/* relume render: recording -> scenes -> pictures -> files. Options: settings.c; threads: pipeline.c; signals:
 * watch.c. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/frames.h"
#include "base/part.h"
#include "base/plural.h"
#include "base/verbs.h"
#include "look/camera/camera.h"
#include "look/rules/join.h"
#include "look/rules/matched.h"
#include "scene/program.h"
#include "tracer/device/outcome.h"
#include "verbs/render/check/apart.h"
#include "verbs/render/look.h"
#include "verbs/render/pipeline.h"
#include "verbs/render/totals.h"

#define MAX_PATH_BYTES 4096
#define MAX_LINES 20 /* about what is missing */

/* How much of what was asked for the recording has. */
struct extent {
	uint64_t end;   /* frames of the recording */
	uint64_t asked; /* frames or pictures, of all chunks */
	uint64_t total; /* frames to render */
	int ends_early; /* 1: it is damaged, and frames after the damage were asked for */
};

/* Check that each picture gets a name of its own. */
static int check_names(const struct settings *s, const struct extent *x)
{
	const char *dot = strrchr(s->output, '.');
	const int are_pictures = settings_number_pictures(s);

	if (x->asked <= 1 || frame_pattern_has_number(s->output))
		return 0;
	return err_report(ERR_USAGE, NULL,
	                  "'%s' holds no place for the frame number, but there are %llu %s: write %.*s.####%s%s", s->output,
	                  (unsigned long long)x->asked, are_pictures ? "pictures" : "frames", (int)(dot - s->output),
	                  s->output, dot, are_pictures ? "" : ", or name one frame with -f");
}

/* Check that the frames asked for are there; cut the list down to the chunk asked for. @return 1: the chunk holds no
 * frame */
static int choose_frames(struct settings *s, struct replay *replay, struct extent *x)
{
	int damaged = 0, err = replay_frame_count(replay, &x->end, &damaged);

	if (err)
		return err;
	x->ends_early = damaged && frame_list_last(&s->frames) >= x->end;
	if (x->end == 0 || (s->frames.n_ranges && frame_list_needed(&s->frames) >= x->end && !damaged))
		return frame_report_missing(s->trace, frame_list_needed(&s->frames), x->end);
	x->asked = frame_list_count(&s->frames, x->end);
	if (s->n_chunks && !settings_number_pictures(s))
		err = frame_list_chunk(&s->frames, x->end, s->chunk, s->n_chunks);
	x->total = frame_list_count(&s->frames, x->end);
	s->moments = (struct moments){ .shutter = (double)s->shutter, .n = x->end };
	return err || settings_number_pictures(s) ? err : check_names(s, x);
}

/* Pictures take the place of the frames that they show, of a turntable or at moments. */
static int list_pictures(struct settings *s, struct replay *replay, struct extent *x)
{
	char range[32];
	int err = 0;

	if (x->ends_early && (!(s->fps > 0) || !x->total))
		return 0;
	if (s->fps > 0)
		err = moments_make(&s->moments, replay, s->trace, &s->frames, x->end, (double)s->fps, (double)s->recorded_fps);
	else if (x->total == 1 && frame_list_next(&s->frames, 0, &s->moments.first))
		s->moments.n = 1;
	else
		err = err_report(ERR_USAGE, s->camera->path, "a turntable shows one recorded frame; -f names it");
	if (err)
		return err;
	x->end = x->asked = s->fps > 0 ? s->moments.count : camera_pictures(s->camera);
	snprintf(range, sizeof(range), "0-%llu", (unsigned long long)x->end - 1);
	frame_list_free(&s->frames);
	err = frame_list_parse(range, &s->frames);
	if (!err && s->n_chunks)
		err = frame_list_chunk(&s->frames, x->end, s->chunk, s->n_chunks);
	x->total = err ? 0 : frame_list_count(&s->frames, x->end);
	return err ? err : check_names(s, x);
}

/* Print what a real run would do. */
static int rehearse(const struct settings *s, const struct stamp *stamp, uint64_t total)
{
	static const char *const words[] = { "render", "render, it is damaged", "render, it has other settings", "leave" };
	uint64_t frame = 0;

	for (uint64_t i = 0; i < total && frame_list_next(&s->frames, frame, &frame); i++, frame++) {
		char path[MAX_PATH_BYTES];
		int err = frame_pattern_expand(s->output, frame, path, sizeof(path));

		if (err)
			return err;
		printf("frame %llu: %s: %s\n", (unsigned long long)frame, path,
		       words[s->skip_existing ? stamp_check(stamp, settings_recorded_frame(s, frame), path) : STAMP_MISSING]);
	}
	return 0;
}

static unsigned default_jobs(void)
{
	long cores = sysconf(_SC_NPROCESSORS_ONLN);

	/* A device runs one frame's kernels while a single core prepares, reads back or clears up another frame. */
	return cores <= 4 ? 2 : cores >= 16 ? 8 : (unsigned)cores / 2;
}

/* --- What frames lack -------------------------------------------------------------------------------------------- */

struct missing {
	struct replay_lack *lacks; /* for frames asked for, from the index */
	long n;
	int any; /* 1: these, or what only drawing has shown */
};

/* Before the first frame: find what those asked for will lack, and say so. */
static int foretell(const struct settings *s, struct replay *replay, uint64_t end, struct missing *m)
{
	long n = replay_lacks(replay, &m->lacks);

	for (long i = 0; i < n; i++) {
		const struct replay_lack *l = &m->lacks[i];
		uint64_t frame;
		char range[64];

		if (!frame_list_next(&s->frames, l->first, &frame) || frame > l->last || frame >= end)
			continue;
		if (l->last == UINT64_MAX)
			snprintf(range, sizeof(range), "from frame %llu on", (unsigned long long)l->first);
		else if (l->last == l->first)
			snprintf(range, sizeof(range), "frame %llu", (unsigned long long)l->first);
		else
			snprintf(range, sizeof(range), "frames %llu to %llu", (unsigned long long)l->first, (unsigned long long)l->last);
		if (m->n < MAX_LINES)
			err_warn(s->trace, "missing, %s: %s%s%s", range, l->name, *l->why ? ": " : "", l->why);
		m->lacks[m->n++] = *l;
	}
	if (m->n > MAX_LINES)
		err_warn(s->trace, "and %ld more command%s that Relume does not know ('relume info' lists them)", m->n - MAX_LINES,
		         plural((uint64_t)(m->n - MAX_LINES)));
	m->any = m->n > 0;
	return n < 0 ? (int)n : 0;
}

static int is_foretold(const struct missing *m, const char *command)
{
	for (long i = 0; i < m->n; i++)
		if (strcmp(m->lacks[i].name, command) == 0)
			return 1;
	return 0;
}

/* Afterwards: what only drawing has shown. */
static void report(const struct pipeline *p, struct missing *m)
{
	const struct tracer_undrawn *u = &p->carried->undrawn;
	const char *trace = p->settings->trace;
	const struct replay_count *counts;
	size_t n = replay_unsupported(p->replay, &counts), said = 0;

	for (size_t i = 0; i < n; i++) {
		m->any |= !replay_is_rendered(&counts[i]);
		if (!is_foretold(m, counts[i].name) && said++ < MAX_LINES)
			err_warn(trace, "%s, %llu time%s: %s", counts[i].name, (unsigned long long)counts[i].count, plural(counts[i].count),
			         counts[i].why ? counts[i].why : "not done yet");
	}
	m->any |= p->carried->lacks || u->targets != 0 || u->ended != 0;
	if (u->ended)
		err_warn(trace,
		         "ended: programs of %llu draw%s, after %u instructions in loops; what they drew is wrong "
		         "(frames say which: relume:ended)",
		         (unsigned long long)u->ended, plural(u->ended), SCENE_PROGRAM_STEPS);
	if (u->targets)
		err_warn(trace, "not drawn yet: %llu draw%s to other targets than the window", (unsigned long long)u->targets,
		         plural(u->targets));
}

static int prepare_device(struct pipeline *p, struct device *dev)
{
	const struct settings *s = p->settings;
	struct carried *c = p->carried;
	char folder[4096];
	int err;

	outcome_remember_builds(dev, p->remembered, &c->run);
	if (outcome_is_hopeless(dev, s->family, p->outcomes, &c->run))
		carried_blame_frame(c);
	err = outcome_choose(dev, s->family, p->outcomes, &c->run);
	if (!s->no_cache && s->cache)
		device_keep_programs(dev, s->cache, 0);
	else if (!s->no_cache && folder_cached("kernels", folder, sizeof(folder)))
		device_keep_programs(dev, folder, 0);
	if (s->progress != PROGRESS_NONE && s->progress != PROGRESS_JSON)
		device_tell_compiling(dev);
	return err ? err : device_take_hook(dev, s->hook);
}

/* Open and prepare all devices. */
static int open_devices(struct pipeline *p)
{
	const struct settings *s = p->settings;
	struct carried *c = p->carried;
	int err = carried_take_fault(c);

	if (!err)
		err = device_open_list(s->device, s->threads, &p->devices, &p->n_devices);
	for (size_t i = 0; i < p->n_devices && !err; i++)
		err = prepare_device(p, p->devices[i]);
	if (err)
		device_close_list(&p->devices, &p->n_devices);
	return err;
}

/* Remove files that killed processes have left. */
static void sweep(const struct settings *s, long gone)
{
	part_sweep(s->output);
	if (gone)
		part_sweep_of(s->output, gone);
	if (s->preview)
		part_sweep(s->preview);
	if (s->preview && gone)
		part_sweep_of(s->preview, gone);
}

static int render_frames(struct pipeline *p, uint64_t total, struct missing *missing)
{
	const struct settings *s = p->settings;
	struct progress *progress = &p->carried->progress;
	int err;

	sweep(s, (long)p->carried->guard.gone);
	err = open_devices(p);
	if (!err && s->kind != DISPLAY_EXR)
		err = display_create(&s->display, &p->display);
	if (err) {
		device_close_list(&p->devices, &p->n_devices);
		return err;
	}
	p->jobs = p->carried->one_by_one ? 1 : s->jobs ? s->jobs : default_jobs();
	if (p->carried->has_begun)
		progress_go_on(progress);
	else
		progress_begin_style(progress, "rendered", total, s->progress);
	p->carried->has_begun = 1;
	err = pipeline_run(p);
	progress_end(progress);
	if (!err || progress->failed) {
		progress_summary(progress);
		totals_print(s, p->carried);
	}
	for (size_t i = 0; i < p->n_devices && p->n_devices > 1 && p->shares && s->progress != PROGRESS_NONE; i++)
		fprintf(stderr, "  device %zu: %llu frame%s (%s)\n", i, (unsigned long long)p->shares[i], plural(p->shares[i]),
		        device_name(p->devices[i]));
	free(p->shares);
	matched_report(s->look, s->progress == PROGRESS_NONE);
	display_destroy(&p->display);
	report(p, missing);
	for (size_t i = 0; i < p->n_devices; i++)
		device_leave_programs(p->devices[i]);
	device_close_list(&p->devices, &p->n_devices);
	return err;
}

/* --look auto, between the files named before and after it. */
static int look_from_study(struct settings *s)
{
	struct look *found = NULL;
	int err = look_study(s->trace, &(struct frame_list){ .n_ranges = 0 }, &found);

	if (!err)
		err = rules_join(&s->look, &found);
	if (!err)
		err = rules_join(&s->look, &s->look_after);
	rules_free(&found);
	return err;
}

static int render(struct settings *s, struct carried *carried)
{
	struct pipeline p = { .settings = s, .carried = carried, .start_s = progress_clock_s() };
	struct extent x = { .total = 0 };
	struct missing missing = { .n = 0 };
	char outcomes[4096];
	int err = settings_confine(s), number = 0;

	if (!err)
		err = watch_start(&p.watch, &carried->guard, &(struct watch_limits){ s->frame_s, s->driver_s, s->memory_bytes });
	if (err)
		return err;
	if (!s->no_cache)
		p.outcomes = s->cache ? s->cache : folder_cached("devices", outcomes, sizeof(outcomes)) ? outcomes : NULL;
	p.remembered = s->hook ? NULL : p.outcomes;
	err = replay_open(&p.replay, s->trace);
	if (!err && !s->no_cache)
		err = blas_store_open(s->cache, s->cache_bytes ? s->cache_bytes : BLAS_STORE_BYTES, &s->tracer.store);
	if (!err)
		err = choose_frames(s, p.replay, &x);
	if (!err)
		err = foretell(s, p.replay, x.end, &missing);
	if (!err && settings_number_pictures(s))
		err = list_pictures(s, p.replay, &x);
	if (!err && s->look_auto && !s->dry_run)
		err = look_from_study(s);
	if (!err) {
		p.stamp = (struct stamp){ .trace = replay_trace_hash(p.replay), .settings = s->hash };
		snprintf(p.stamp.program, sizeof(p.stamp.program), "%s", replay_program(p.replay)); /* the replay's own
		                                                                                       goes where it
		                                                                                       goes back */
		p.end = x.end;
		err = s->dry_run ? rehearse(s, &p.stamp, x.total) : render_frames(&p, x.total, &missing);
	}
	if (!err && x.ends_early)
		err = err_report(ERR_INPUT, s->trace, "is damaged after frame %llu; frames up to there are done",
		                 (unsigned long long)x.end - 1);
	if (!err && missing.any && !s->allow_incomplete && !s->dry_run)
		err = err_report(ERR_INCOMPLETE, s->trace,
		                 "every frame is there, but draws are missing (--allow-incomplete: exit with 0)");
	free(missing.lacks);
	number = watch_signal(p.watch);
	if (number)
		err_report(ERR_SYSTEM, NULL, "stopped by %s; the same command with --skip-existing goes on",
		           strsignal(number));
	replay_close(&p.replay);
	blas_store_close(&s->tracer.store);
	watch_stop(&p.watch);
	return number ? -(128 + number) : err;
}

/* In the run's worker process. */
struct task {
	struct settings settings;
	struct carried *carried;
};

static int work(void *user)
{
	struct task *task = user;
	int err;

	if (task->carried->guard.attempt) {
		fault_begin(&task->carried->guard.journal, task->settings.family < 0);
		err_carry_on(&task->carried->lines, task->carried->guard.attempt);
	}
	err = render(&task->settings, task->carried);
	fault_end();
	settings_free(&task->settings);
	return err == 1 ? 0 : -err; /* 1: nothing to do */
}

int render_main(int argc, char **argv)
{
	struct task task = { .carried = NULL };
	int err = settings_parse(&task.settings, argc, argv);

	if (!err)
		task.carried = apart_alloc(sizeof(*task.carried));
	if (err || !task.carried) {
		settings_free(&task.settings);
		return err == 1 ? 0 : err ? -err : -ERR_SYSTEM;
	}
	/* Without calls of a driver, nothing needs watching. */
	if (task.settings.dry_run || device_is_reference(task.settings.device))
		return work(&task);
	return guard_run(&task.carried->guard, work, &task);
}
