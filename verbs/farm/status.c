#include "verbs/farm/status.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/plural.h"
#include "verbs/farm/census.h"
#include "verbs/farm/running.h"
#include "verbs/farm/slurm.h"
#include "verbs/farm/spans.h"
#include "verbs/farm/task.h"

enum { MOST_FAILED = 20 }; /* tasks that are named */

/* The tasks that wait and run. */
struct work {
	struct slurm_queue queue;
	char process[32]; /* without Slurm: the process at work, or "" */
	int is_over;
};

static int read_work(const struct farm_job *job, struct work *out)
{
	int err = 0;

	*out = (struct work){ 0 };
	if (job->engine == FARM_SLURM)
		err = slurm_read(job, &out->queue);
	else
		running_process(job, out->process, sizeof(out->process));
	out->is_over = !out->queue.running && !out->queue.waiting && !out->queue.report && !out->process[0];
	return err;
}

/* ", 12 frames a minute, about 3 min left", while something runs. */
static void print_rate(const struct farm_job *job, const struct work *work, uint64_t left)
{
	double rate = work->is_over || !left ? 0 : census_rate(job), seconds = rate > 0 ? (double)left / rate : 0;

	if (rate <= 0)
		return;
	printf("; %.*f frames a minute, about ", 60 * rate < 10 ? 1 : 0, 60 * rate);
	if (seconds < 90)
		printf("%.0f s left", seconds);
	else if (seconds < 90 * 60)
		printf("%.0f min left", seconds / 60);
	else
		printf("%.1f h left", seconds / 3600);
}

static void print_frames(const struct census *c)
{
	static const char *const words[N_CENSUS_VERDICTS] = { "missing", "damaged", "rendered with other settings" };

	for (int k = 0; k < N_CENSUS_VERDICTS; k++) {
		struct spans spans = { .out = stdout };

		if (!c->counts[k])
			continue;
		printf("%s: frame%s ", words[k], plural(c->counts[k]));
		for (size_t i = 0; i < c->n_wanting; i++)
			if (c->wanting[i].verdict == (enum census_verdict)k)
				spans_add(&spans, c->wanting[i].frame);
		spans_end(&spans);
		putchar('\n');
	}
}

static int print_task_frames(const struct farm_job *job, uint64_t task)
{
	struct spans spans = { .out = stdout };
	struct frame_list list = { 0 };
	uint64_t frame = 0;
	int err = frame_list_parse(job->pictures_text, &list);

	if (!err && frame_list_chunk(&list, UINT64_MAX, task, job->n_tasks) == 0)
		for (uint64_t from = 0; frame_list_next(&list, from, &frame); from = frame + 1)
			spans_add(&spans, frame);
	spans_end(&spans);
	frame_list_free(&list);
	return err;
}

/* "exit code 5", "signal 9 (Killed)", "killed (OUT_OF_MEMORY)" */
static void print_end(const struct task_story *story, const char *by_slurm)
{
	if (story->state == TASK_ENDED && story->code > 128)
		printf("ended by signal %d (%s)", story->code - 128, strsignal(story->code - 128));
	else if (story->state == TASK_ENDED)
		printf("exit code %d", story->code);
	else if (story->state == TASK_BEGUN)
		printf("killed with its script");
	else
		printf("never began");
	if (by_slurm && (story->state != TASK_ENDED || strncmp(by_slurm, "FAILED", 6) != 0))
		printf(" (Slurm: %s)", by_slurm);
}

static int print_failed_task(const struct farm_job *job, uint64_t task, const struct task_story *story,
                             const char *by_slurm)
{
	char name[24], path[PATH_MAX + 32];
	int err;

	snprintf(name, sizeof(name), "%" PRIu64, task);
	printf("task %s, frames ", name);
	err = print_task_frames(job, task);
	fputs(": ", stdout);
	print_end(story, by_slurm);
	task_log(job, name, path, sizeof(path));
	printf(access(path, R_OK) == 0 ? "; log %s\n" : "\n", path);
	if (story->last[0])
		printf("    %s\n", story->last);
	return err;
}

/* Tasks that have frames to render, but neither wait nor run: print why. */
static int print_failed(const struct farm_job *job, const struct census *c, const struct slurm_queue *queue)
{
	uint64_t n = 0;
	char **ends;
	int err = slurm_read_ends(job, &ends);

	for (uint64_t i = 1; i <= job->n_tasks && !err; i++) {
		struct task_story story;
		char name[24];

		if (!c->needs[i] || queue->holds[i])
			continue;
		snprintf(name, sizeof(name), "%" PRIu64, i);
		task_read(job, name, &story);
		/* It succeeded, and its frames were changed later. */
		if (story.state == TASK_ENDED && story.code == 0)
			continue;
		if (n++ < MOST_FAILED)
			err = print_failed_task(job, i, &story, ends[i]);
	}
	if (n > MOST_FAILED)
		printf("and %" PRIu64 " more failed task%s\n", n - MOST_FAILED, plural(n - MOST_FAILED));
	if (n)
		printf("'relume farm retry %s' renders what is missing\n", job->folder);
	for (uint64_t i = 0; ends && i <= job->n_tasks; i++)
		free(ends[i]);
	free(ends);
	return err;
}

static void print_work(const struct farm_job *job, const struct work *work)
{
	const struct slurm_queue *q = &work->queue;
	struct task_story report;

	if (job->engine != FARM_SLURM) {
		printf(work->process[0] ? "process %s is at work" : "nothing is at work", work->process);
		return;
	}
	task_read(job, "report", &report);
	printf("tasks %" PRIu64 " running, %" PRIu64 " waiting; report ", q->running, q->waiting);
	if (q->report)
		printf("waiting or running");
	else if (report.state == TASK_ENDED)
		printf("exit code %d", report.code);
	else
		printf("not in the queue");
}

/* @param c  taken here; the caller frees it */
static int print_state(const struct farm_job *job, struct census *c, struct work *work)
{
	char path[PATH_MAX + 32];
	int err = census_take(job, c);

	if (!err)
		err = read_work(job, work);
	if (err)
		return err;
	printf("frames %" PRIu64 " of %" PRIu64 " whole, %" PRIu64 " missing, %" PRIu64 " damaged, %" PRIu64
	       " rendered with other settings\n",
	       c->whole, job->n_pictures, c->counts[CENSUS_MISSING], c->counts[CENSUS_DAMAGED],
	       c->counts[CENSUS_OUTDATED]);
	print_frames(c);
	print_work(job, work);
	print_rate(job, work, c->n_wanting);
	putchar('\n');
	if (job->engine == FARM_SLURM)
		err = print_failed(job, c, &work->queue);
	snprintf(path, sizeof(path), "%s/report/index.html", job->folder);
	if (access(path, R_OK) == 0)
		printf("page %s\n", path);
	if (!err)
		err = c->n_wanting ? ERR_FAILED : 0;
	return fflush(stdout) ? err_report(ERR_SYSTEM, NULL, "cannot write to standard output") : err;
}

/* One line, without reading the frames. */
static int print_progress(const struct farm_job *job, const struct census *c, struct work *work)
{
	uint64_t landed = census_landed(job, c);
	const time_t now = time(NULL);
	char clock[16];
	int err;

	slurm_free(&work->queue);
	err = read_work(job, work);
	if (err || work->is_over)
		return err;
	strftime(clock, sizeof(clock), "%H:%M:%S", localtime(&now));
	printf("%s  frames %" PRIu64 " of %" PRIu64 "; ", clock, c->whole + landed, job->n_pictures);
	print_work(job, work);
	print_rate(job, work, c->n_wanting - landed);
	putchar('\n');
	return fflush(stdout) ? err_report(ERR_SYSTEM, NULL, "cannot write to standard output") : 0;
}

int status_print(const struct farm_job *job, unsigned interval_s)
{
	struct census census = { 0 };
	struct work work = { 0 };
	int err = print_state(job, &census, &work);

	if (interval_s && !work.is_over && (!err || err == ERR_FAILED)) {
		do {
			sleep(interval_s);
			err = print_progress(job, &census, &work);
		} while (!err && !work.is_over);
		census_free(&census);
		slurm_free(&work.queue);
		if (!err)
			err = print_state(job, &census, &work);
	}
	slurm_free(&work.queue);
	census_free(&census);
	return err;
}
