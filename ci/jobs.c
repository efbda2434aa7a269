/* Runs the programs of a plan in parallel, and prints their output in the order of the plan. */
#include "ci/jobs.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/err.h"

struct job {
	const char *name;
	FILE *output; /* from all its processes */
	pid_t pid;    /* 0: not started, or done */
};

size_t jobs_default(void)
{
	const long n = sysconf(_SC_NPROCESSORS_ONLN);

	return n > 1 ? (size_t)n : 1;
}

/* Start a program in a process of its own. @return 0 or ERR_SYSTEM (reported) */
static int start(const struct ci_run *run, const struct ci_program *program, struct job *job)
{
	job->name = program->name;
	job->output = tmpfile();
	if (!job->output)
		return err_report(ERR_SYSTEM, program->name, "no temporary file for its output: %s", strerror(errno));
	fflush(stdout);
	job->pid = fork();
	if (job->pid < 0)
		return err_report(ERR_SYSTEM, program->name, "cannot start a process: %s", strerror(errno));
	if (job->pid == 0) {
		prctl(PR_SET_PDEATHSIG, SIGTERM);
		if (dup2(fileno(job->output), STDOUT_FILENO) < 0 || dup2(fileno(job->output), STDERR_FILENO) < 0)
			_exit(-ERR_SYSTEM);
		const int code = ci_run_program(run, program);

		fflush(stdout);
		_exit(code);
	}
	return 0;
}

/* Wait until any job ends. @return its index; n if none is running */
static size_t wait_for_any(struct job *jobs, size_t n, int *codes)
{
	int status;
	pid_t pid;

	while ((pid = waitpid(-1, &status, 0)) < 0 && errno == EINTR)
		;
	for (size_t i = 0; pid > 0 && i < n; i++)
		if (jobs[i].pid == pid) {
			jobs[i].pid = 0;
			codes[i] = WIFEXITED(status) ? WEXITSTATUS(status)
				: -err_report(ERR_SYSTEM, jobs[i].name, "ended by signal %d", WTERMSIG(status));
			return i;
		}
	return n;
}

/* Print a job's output. */
static void print(struct job *job)
{
	char text[4096];
	size_t n;

	rewind(job->output);
	while ((n = fread(text, 1, sizeof(text), job->output)) > 0)
		fwrite(text, 1, n, stdout);
	fflush(stdout);
	fclose(job->output);
	job->output = NULL;
}

static int run_several(const struct ci_run *run, const struct ci_program *const *programs, struct job *jobs, size_t n,
                       size_t n_jobs, int *codes)
{
	size_t n_started = 0, n_running = 0, n_printed = 0;
	int err = 0;

	while (n_printed < n_started || (!err && n_started < n)) {
		for (; !err && n_started < n && n_running < n_jobs; n_running += !err, n_started += !err)
			err = start(run, programs[n_started], &jobs[n_started]);
		if (n_running && wait_for_any(jobs, n_started, codes) < n_started)
			n_running--;
		for (; n_printed < n_started && !jobs[n_printed].pid; n_printed++)
			print(&jobs[n_printed]);
	}
	return err;
}

int jobs_run(const struct ci_run *run, const struct ci_program *const *programs, size_t n, size_t n_jobs, int *codes)
{
	struct job *jobs;
	int err;

	if (n == 1 || n_jobs == 1) {
		for (size_t i = 0; i < n; i++)
			codes[i] = ci_run_program(run, programs[i]);
		return 0;
	}
	jobs = calloc(n, sizeof(*jobs));
	if (!jobs)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	err = run_several(run, programs, jobs, n, n_jobs, codes);
	for (size_t i = 0; i < n; i++)
		if (jobs[i].output)
			fclose(jobs[i].output);
	free(jobs);
	return err;
}
