/* relume farm: many machines. submit and retry run the script; status and cancel ask the files and Slurm. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/verbs.h"
#include "farm/job.h"
#include "farm/program.h"
#include "farm/script.h"
#include "farm/slurm.h"

/* --- What the frames say ------------------------------------------------------------------------------------------ */

struct census {
	uint64_t whole, missing, damaged, outdated;
	unsigned char *needs; /* [n_tasks + 1]: whether the task of that number has a frame to render; owned */
};

/* "frame 7: out/gears.0007.exr: leave", as `relume render --dry-run` says it. */
static void count_line(const struct farm_job *job, const char *line, struct census *c)
{
	uint64_t frame = 0;
	const char *verdict = line;

	if (sscanf(line, "frame %" SCNu64 ":", &frame) != 1)
		return;
	for (const char *p = line; (p = strstr(p, ": ")); p += 2)
		verdict = p + 2;
	if (strcmp(verdict, "leave") == 0) {
		c->whole++;
		return;
	}
	if (strstr(verdict, "damaged"))
		c->damaged++;
	else if (strstr(verdict, "otherwise"))
		c->outdated++;
	else
		c->missing++;
	c->needs[farm_job_task_of(job, frame)] = 1;
}

/* Which frames are whole? This is also the check of everything that a task will be told. */
static int take_census(const struct farm_job *job, struct census *out)
{
	char **argv = calloc((size_t)job->n_render + 12, sizeof(*argv)), *text = NULL;
	int n = 0, rc;

	*out = (struct census){ .needs = calloc(job->n_tasks + 1, 1) };
	if (!argv || !out->needs) {
		free(argv);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	argv[n++] = (char *)job->relume;
	argv[n++] = "render";
	for (int i = 0; i < job->n_render; i++)
		argv[n++] = job->render[i];
	argv[n++] = "-f";
	argv[n++] = (char *)job->frames_text;
	argv[n++] = "-o";
	argv[n++] = (char *)job->output;
	argv[n++] = "--skip-existing";
	argv[n++] = "--dry-run";
	argv[n++] = "--";
	argv[n++] = (char *)job->trace;
	rc = program_read(argv, &text);
	for (char *line = rc == 0 ? strtok(text, "\n") : NULL; line; line = strtok(NULL, "\n"))
		count_line(job, line, out);
	free(text);
	free(argv);
	/* It has said what is wrong. */
	return rc <= 0 ? rc : rc <= -ERR_SYSTEM ? -rc : ERR_SYSTEM;
}

/* Tasks as "3,17,40-42" or "none"; the caller's. */
static char *list_tasks(const struct farm_job *job, const struct census *c)
{
	char *text = malloc(job->n_tasks * 22 + 8), *p = text;

	if (!text)
		return NULL;
	for (uint64_t i = 1; i <= job->n_tasks; i++) {
		uint64_t last = i;

		if (!c->needs[i])
			continue;
		while (last < job->n_tasks && c->needs[last + 1])
			last++;
		p += sprintf(p, "%s%" PRIu64, p > text ? "," : "", i);
		if (last > i)
			p += sprintf(p, "-%" PRIu64, last);
		i = last;
	}
	if (p == text)
		strcpy(text, "none");
	return text;
}

/* --- The verbs ----------------------------------------------------------------------------------------------------- */

/* Becomes the script; returns only where it cannot. */
static int run_script(const struct farm_job *job, const char *tasks)
{
	char path[PATH_MAX + 16];

	snprintf(path, sizeof(path), "%s/job.sh", job->folder);
	printf("job %s\n", job->folder);
	fflush(stdout);
	execl("/bin/sh", "sh", path, tasks, (char *)NULL);
	return err_report(ERR_SYSTEM, "/bin/sh", "cannot start: %s", strerror(errno));
}

static int submit(int argc, char **argv)
{
	struct farm_job job = { 0 };
	struct census census = { 0 };
	int err = farm_job_parse(argc, argv, &job);

	if (!err && job.engine != FARM_LOCAL && job.engine != FARM_SLURM)
		err = err_report(ERR_USAGE, NULL, "--for belongs to 'relume farm script'");
	if (!err)
		err = take_census(&job, &census);
	if (!err && job.engine == FARM_SLURM)
		err = slurm_check_size(&job);
	if (!err)
		err = farm_job_save(&job);
	if (!err)
		err = farm_script_save(&job);
	if (!err)
		err = run_script(&job, NULL);
	free(census.needs);
	farm_job_free(&job);
	return err;
}

static int script(int argc, char **argv)
{
	struct farm_job job = { 0 };
	int err = farm_job_parse(argc, argv, &job);

	if (!err && job.asked_engine < 0)
		err = err_report(ERR_USAGE, NULL, "for which engine? --for takes slurm, parallel or make");
	if (!err)
		err = farm_script_print(&job, stdout);
	if (!err && fflush(stdout))
		err = err_report(ERR_SYSTEM, NULL, "cannot write: %s", strerror(errno));
	farm_job_free(&job);
	return err;
}

static int status(struct farm_job *job)
{
	struct census census;
	struct slurm_queue queue = { 0 };
	char path[PATH_MAX + 32];
	int err = take_census(job, &census);

	if (!err && job->engine == FARM_SLURM)
		err = slurm_read(job, &queue);
	if (err)
		goto done;
	printf("frames %" PRIu64 " of %" PRIu64 " whole, %" PRIu64 " missing, %" PRIu64 " damaged, %" PRIu64 " made otherwise\n",
	       census.whole, job->n_frames, census.missing, census.damaged, census.outdated);
	if (job->engine == FARM_SLURM)
		printf("tasks %" PRIu64 " running, %" PRIu64 " waiting; report %s\n", queue.running, queue.waiting,
		       queue.report ? "waiting or running" : "not in the queue");
	snprintf(path, sizeof(path), "%s/report/index.html", job->folder);
	if (access(path, R_OK) == 0)
		printf("page %s\n", path);
	err = census.whole == job->n_frames ? 0 : ERR_FAILED;
done:
	slurm_free(&queue);
	free(census.needs);
	return err;
}

static int retry(struct farm_job *job)
{
	struct census census = { 0 };
	struct slurm_queue queue = { 0 };
	char *tasks = NULL;
	/* Asked before the frames are: the frames of a task that has left the queue by then have all been written. */
	int err = job->engine == FARM_SLURM ? slurm_read(job, &queue) : 0;

	if (!err)
		err = slurm_release(&queue);
	if (!err)
		err = take_census(job, &census);
	/* What waits or runs is in good hands. */
	for (uint64_t i = 1; !err && i <= job->n_tasks; i++)
		if (queue.holds && queue.holds[i])
			census.needs[i] = 0;
	if (!err && !(tasks = list_tasks(job, &census)))
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		err = farm_script_save(job);
	if (!err && queue.report && strcmp(tasks, "none") == 0)
		puts("all that is missing waits or runs already");
	else if (!err)
		err = run_script(job, job->engine == FARM_SLURM ? tasks : NULL);
	free(tasks);
	slurm_free(&queue);
	free(census.needs);
	return err;
}

static int cancel(struct farm_job *job)
{
	if (job->engine != FARM_SLURM)
		return err_report(ERR_USAGE, job->folder, "runs where it was started; end it there");
	return slurm_cancel(job);
}

static int with_job(int argc, char **argv, int (*verb)(struct farm_job *))
{
	struct farm_job job = { 0 };
	int err;

	if (argc != 2 || argv[1][0] == '-')
		return err_report(ERR_USAGE, NULL, "relume farm %s takes the FOLDER that submit printed", argv[0]);
	err = farm_job_load(argv[1], &job);
	if (!err)
		err = verb(&job);
	farm_job_free(&job);
	return err;
}

/* What stands behind `relume farm`: the words of a new job, or the folder of one. */
static const struct {
	const char *name;
	int (*with_words)(int argc, char **argv);
	int (*with_job)(struct farm_job *job);
} verbs[] = {
	{ "submit", submit, NULL }, { "script", script, NULL }, { "status", NULL, status }, { "retry", NULL, retry }, { "cancel", NULL, cancel },
};

int farm_main(int argc, char **argv)
{
	const char *name = argc > 1 ? argv[1] : "";
	size_t i = 0;
	int err;

	if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
		options_print_help(&farm_options, stdout);
		return 0;
	}
	while (i < sizeof(verbs) / sizeof(verbs[0]) && strcmp(name, verbs[i].name) != 0)
		i++;
	if (i == sizeof(verbs) / sizeof(verbs[0]))
		err = err_report(ERR_USAGE, NULL, "relume farm takes submit, script, status, retry or cancel, not '%s'", name);
	else if (verbs[i].with_words)
		err = verbs[i].with_words(argc - 1, argv + 1);
	else
		err = with_job(argc - 1, argv + 1, verbs[i].with_job);
	return err > 0 ? 0 : -err;
}
