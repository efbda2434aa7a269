/* relume farm: many machines. submit and retry run the script; status and cancel ask the files and Slurm. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/plural.h"
#include "base/verbs.h"
#include "verbs/farm/census.h"
#include "verbs/farm/job.h"
#include "verbs/farm/running.h"
#include "verbs/farm/script.h"
#include "verbs/farm/slurm.h"
#include "verbs/farm/status.h"

enum { DEFAULT_INTERVAL_S = 10, MOST_INTERVAL_S = 86400 };

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

/* Replace this process with the script; returns only on failure. */
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
		err = census_take(&job, &census);
	if (!err && job.engine == FARM_SLURM)
		err = slurm_check_size(&job);
	if (!err)
		err = running_claim(&job, job.replace);
	if (!err)
		err = farm_job_save(&job);
	if (!err)
		err = farm_script_save(&job);
	if (!err && census.counts[CENSUS_OUTDATED])
		printf("rendered again, for other settings: %" PRIu64 " frame%s\n", census.counts[CENSUS_OUTDATED],
		       plural(census.counts[CENSUS_OUTDATED]));
	if (!err)
		err = run_script(&job, NULL);
	census_free(&census);
	farm_job_free(&job);
	return err;
}

static int script(int argc, char **argv)
{
	struct farm_job job = { 0 };
	int err = farm_job_parse(argc, argv, &job);

	if (!err && job.asked_engine < 0)
		err = err_report(ERR_USAGE, NULL, "no engine given: --for takes slurm, parallel or make");
	if (!err)
		err = farm_script_print(&job, stdout);
	if (!err && fflush(stdout))
		err = err_report(ERR_SYSTEM, NULL, "cannot write: %s", strerror(errno));
	farm_job_free(&job);
	return err;
}

static int retry(struct farm_job *job)
{
	struct census census = { 0 };
	struct slurm_queue queue = { 0 };
	char *tasks = NULL;
	/* Query the queue before the frames: a task that has left the queue by then has written all its frames. */
	int err = job->engine == FARM_SLURM ? slurm_read(job, &queue) : 0;

	if (!err)
		err = slurm_release(&queue);
	if (!err)
		err = census_take(job, &census);
	/* Leave out tasks that wait or run. */
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
	census_free(&census);
	return err;
}

static int cancel(struct farm_job *job)
{
	if (job->engine != FARM_SLURM)
		return err_report(ERR_USAGE, job->folder, "runs where it was started; end it there");
	return slurm_cancel(job);
}

/* "--watch" or "--watch=N". @return seconds, 0 where `word` is neither */
static unsigned watch_interval(const char *word)
{
	unsigned long n = DEFAULT_INTERVAL_S;
	char *end = "";

	if (strncmp(word, "--watch", 7) != 0)
		return 0;
	if (word[7] == '=' && word[8] >= '0' && word[8] <= '9')
		n = strtoul(word + 8, &end, 10);
	else if (word[7])
		return 0;
	return *end || n > MOST_INTERVAL_S ? 0 : (unsigned)n;
}

static int with_job(int argc, char **argv, int (*verb)(struct farm_job *))
{
	struct farm_job job = { 0 };
	unsigned interval_s = argc == 3 && !verb ? watch_interval(argv[1]) : 0;
	const char *folder = argc > 1 ? argv[argc - 1] : "-";
	int err;

	if (argc != (interval_s ? 3 : 2) || folder[0] == '-')
		return err_report(ERR_USAGE, NULL, "farm %s takes %sthe FOLDER that submit printed", argv[0],
		                  verb ? "" : "[--watch[=SECONDS]] and ");
	err = farm_job_load(folder, &job);
	if (!err)
		err = verb ? verb(&job) : status_print(&job, interval_s);
	farm_job_free(&job);
	return err;
}

/* The subcommands: they take the words of a new job, or a job's folder; status takes more and is in neither column. */
static const struct {
	const char *name;
	int (*with_words)(int argc, char **argv);
	int (*with_job)(struct farm_job *job);
} verbs[] = {
	{ "submit", submit, NULL }, { "script", script, NULL }, { "status", NULL, NULL }, { "retry", NULL, retry },
	{ "cancel", NULL, cancel },
};

static int refuse(const char *name)
{
	if (!*name)
		return err_report(ERR_USAGE, NULL,
		                  "farm takes submit, script, status, retry or cancel; 'relume help farm' says more");
	if (name[0] == '-')
		return err_report(ERR_USAGE, NULL, "farm has no option '%s' before submit, script, status, retry or cancel; "
		                                   "'relume help farm' lists them", name);
	return err_report(ERR_USAGE, NULL, "farm takes submit, script, status, retry or cancel, not '%s'", name);
}

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
		err = refuse(name);
	else if (verbs[i].with_words)
		err = verbs[i].with_words(argc - 1, argv + 1);
	else
		err = with_job(argc - 1, argv + 1, verbs[i].with_job);
	return err > 0 ? 0 : -err;
}
