/* relume ci: record programs, render the recordings and gate the frames, for continuous integration. */
#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/options.h"
#include "base/program.h"
#include "base/verbs.h"
#include "ci/jobs.h"
#include "ci/plan.h"
#include "ci/server.h"
#include "ci/steps.h"

enum { BISECT_SKIPS = 125 }; /* exit code that makes 'git bisect run' skip a commit */

/* Values of an option that may be repeated. */
struct texts {
	char **at; /* owned; the texts are borrowed */
	size_t n, room;
};

/* The command line. */
struct asked {
	const char *file, *kept, *baseline;
	struct ci_program program; /* from the command line; its name may select a program of the file */
	struct texts environment, press, data;
	unsigned jobs; /* 0: choose a number that suits the machine */
	int when_changed, own_displays, bisects;
};

static int take_text(const struct options_row *row, const char *value, void *out)
{
	struct texts *texts = out;

	(void)row;
	if (MEMORY_GROW(texts->at, texts->room, texts->n + 1))
		return ERR_SYSTEM;
	texts->at[texts->n++] = (char *)value;
	return 0;
}

static int take_name(const struct options_row *row, const char *value, void *out)
{
	char **name = out;

	(void)row;
	free(*name);
	*name = strdup(value);
	return *name ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
}

#define AT(member) .at = offsetof(struct asked, member)

static const struct options_row rows[] = {
	{ "name", 'n', "NAME", "name of the results folder (default: the program's name); without PROGRAM: the only one "
	  "of the file to run", take_name, AT(program.name) },
	{ "frames", 'f', "N", "frames to record, from the program's first (default 10)", options_number,
	  AT(program.frames), .most = CI_MOST_FRAMES },
	{ "env", 0, "NAME=VALUE", "set a variable for the program; may be repeated", take_text, AT(environment) },
	{ "press", 0, "KEY@FRAME", "press KEY so that FRAME is the first to show it, as in 'relume record --press'; "
	  "may be repeated", take_text, AT(press) },
	{ "when-changed", 0, NULL, "record only if a watched input has changed, and list what is watched: the program, "
	  "its libraries as the loader lists them, files named by its arguments, --data, --env, --press and --frames",
	  options_flag, AT(when_changed) },
	{ "data", 0, "FILE", "another file or folder that the program reads; may be repeated", take_text,
	  AT(data) },
	{ "kept", 'k', "DIR", "recordings, frames and results, kept between runs (default: ci)", options_text,
	  AT(kept) },
	{ "baseline", 'b', "DIR", "approved frames, with a subfolder for each program (default: approved)", options_text,
	  AT(baseline) },
	{ "config", 0, "FILE", "tolerances, masks and flaky frames, as in 'relume diff --config'", options_text,
	  AT(program.config) },
	{ "jobs", 'j', "N", "programs to run at a time (default: one per processor core); they take turns on the "
	  "display", options_number, AT(jobs), .least = 1, .most = CI_MOST_JOBS },
	{ "xvfb", 0, NULL, "record each program on its own display (by xvfb-run), several at a time", options_flag,
	  AT(own_displays) },
	{ "bisect", 0, NULL, "for 'git bisect run relume ci --bisect': exit with 125, which skips the commit, if pictures "
	  "could not be compared or are not approved", options_flag, AT(bisects) },
	{ "programs", 0, "FILE", "without PROGRAM: list of programs to run (default: relume-ci.yaml)", options_text,
	  AT(file) },
};

static const struct options_table table = {
	.verb = "ci",
	.head = "usage: relume ci [OPTIONS] -- PROGRAM [ARGUMENTS]\n"
		"       relume ci [OPTIONS]\n"
		"\n"
		"Record a program, render its frames, and gate each against what the program itself showed and "
	        "against\n"
		"the approved frames. Without PROGRAM: all programs that relume-ci.yaml lists ('relume help ci-file' "
	        "has its keys).\n"
		"\n"
		"The program needs a display; on a server, --xvfb makes one.\n"
		"Frames that are whole and of the same recording, settings and version are not rendered again. "
	        "DIR/NAME\n"
		"of --kept holds report/index.html, junit.xml, scores.json and summary.md, whatever the exit code. "
	        "The\n"
		"summary is added to the file that GITHUB_STEP_SUMMARY names, where that is set; where GITHUB_ACTIONS "
	        "is\n"
		"true, frames are marked in the log (::error, ::warning).\n",
	OPTIONS_ROWS(rows),
	.notes = "Exit codes: 0 all passed; 1 a picture changed or is missing; 2 wrong usage; 3 an input cannot be "
	         "read;\n"
		 "4 frames that nobody has approved yet; 5 a program is missing, ended with an error or showed "
	         "nothing,\n"
		 "or the system failed. Of several programs, the first of 5, 3, 2, 6, 1, 4 that one of them has.\n",
	.most = -1,
	.stops = 1,
};

/* The worse of two exit codes: a failure to compare ranks above any result of a comparison. */
static int worse(int a, int b)
{
	static const int order[] = { 0, -ERR_BASELINE, -ERR_FAILED, -ERR_INCOMPLETE, -ERR_USAGE, -ERR_INPUT,
	                             -ERR_SYSTEM };
	size_t rank_a = 0, rank_b = 0, n = sizeof(order) / sizeof(order[0]);

	while (rank_a < n && order[rank_a] != a)
		rank_a++;
	while (rank_b < n && order[rank_b] != b)
		rank_b++;
	return rank_a > rank_b ? a : b; /* an interrupted step's code is in no list and wins */
}

static const char *verdict_of(int code)
{
	return code == 0 ? "passed" : code == -ERR_FAILED ? "failed: pictures have changed"
		: code == -ERR_BASELINE ? "not approved yet" : "could not be compared";
}

/* Programs of the file to run: those named `name`, or all if it is NULL. The caller frees the list. */
static const struct ci_program **choose(const struct ci_plan *plan, const char *name, size_t *n)
{
	const struct ci_program **chosen = calloc(plan->n_programs, sizeof(*chosen));

	*n = 0;
	for (uint32_t i = 0; chosen && i < plan->n_programs; i++)
		if (!name || strcmp(name, plan->programs[i].name) == 0)
			chosen[(*n)++] = &plan->programs[i];
	return chosen;
}

static void add_summary(const struct ci_run *run, const struct ci_program *program)
{
	char path[PATH_MAX];

	if (snprintf(path, sizeof(path), "%s/%s/summary.md", run->kept, program->name) < (int)sizeof(path))
		server_add_summary(path);
}

/* Run programs, and print a line for each if there are several. They share one display in turn, so parallel jobs need a
 * lock. @return the exit code */
static int run_programs(struct ci_run *run, const struct ci_program *const *programs, size_t n, size_t n_jobs)
{
	int *codes = calloc(n, sizeof(*codes)), code = 0, err;
	const int share = n > 1 && n_jobs > 1 && !run->own_displays;
	FILE *lock = share ? tmpfile() : NULL;

	if (share && !lock)
		n_jobs = 1;
	run->display_lock = lock ? fileno(lock) : -1;
	err = codes ? jobs_run(run, programs, n, n_jobs, codes) : err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; !err && i < n; i++) {
		add_summary(run, programs[i]);
		code = worse(code, codes[i]);
		if (n > 1)
			printf("%s: %s\n", programs[i]->name, verdict_of(codes[i]));
	}
	if (lock)
		fclose(lock);
	free(codes);
	return err ? -err : code;
}

/* Run programs of the file. @return the exit code */
static int run_file(const struct asked *asked, struct ci_run *run)
{
	struct ci_plan *plan;
	const struct ci_program **chosen = NULL;
	int err = ci_plan_read(asked->file, &plan), code = 0;
	size_t n = 0;

	if (!err && !(chosen = choose(plan, asked->program.name, &n)))
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err && n == 0)
		err = err_report(ERR_USAGE, asked->file, "there is no program '%s'", asked->program.name);
	if (!err && !run->baseline)
		run->baseline = plan->baseline;
	run->baseline = run->baseline ? run->baseline : "approved";
	if (!err)
		code = run_programs(run, chosen, n, asked->jobs ? asked->jobs : jobs_default());
	free(chosen);
	ci_plan_free(&plan);
	return err ? -err : code;
}

/* Run the program of the command line or, without one, those of the file. @return the exit code */
static int run_all(struct asked *asked, const struct options_line *line)
{
	struct ci_program *p = &asked->program;
	char self[PATH_MAX] = "";
	struct ci_run run = {
		.relume = self, .kept = asked->kept, .baseline = asked->baseline, .when_changed = asked->when_changed,
		.own_displays = asked->own_displays,
	};
	int err;

	if (readlink("/proc/self/exe", self, sizeof(self) - 1) < 0)
		return -err_report(ERR_SYSTEM, NULL, "cannot find this command's own path: %s", strerror(errno));
	if (run.own_displays && !program_exists("xvfb-run"))
		return -err_report(ERR_SYSTEM, NULL, "--xvfb needs the program 'xvfb-run' (Debian's package xvfb)");
	if (!line->n_words && (p->frames || p->config || asked->environment.n || asked->press.n || asked->data.n))
		return -err_report(ERR_USAGE, NULL, "--frames, --config, --env, --press and --data are for a PROGRAM; %s has its own",
		                   asked->file);
	if (!line->n_words && access(asked->file, F_OK) != 0 && errno == ENOENT)
		return -err_report(ERR_INPUT, asked->file,
		                   "there is no such file: name a program, as in 'relume ci -- ./game', or list programs there "
		                   "('relume help ci-file' has the keys)");
	if (!line->n_words)
		return run_file(asked, &run);
	p->command = line->words;
	p->n_command = (uint32_t)line->n_words;
	p->environment = asked->environment.at;
	p->n_environment = (uint32_t)asked->environment.n;
	p->press = asked->press.at;
	p->n_press = (uint32_t)asked->press.n;
	p->data = asked->data.at;
	p->n_data = (uint32_t)asked->data.n;
	run.baseline = run.baseline ? run.baseline : "approved";
	err = ci_program_check(p, NULL);
	return err ? -err : run_programs(&run, &(const struct ci_program *){ p }, 1, 1);
}

int ci_main(int argc, char **argv)
{
	struct asked asked = { .file = "relume-ci.yaml", .kept = "ci" };
	struct options_line line;
	int err = options_parse(&table, argc, argv, &asked, &line);
	int code;

	signal(SIGCHLD, SIG_DFL); /* if ignored, no exit status would be left to read */
	code = err ? err > 0 ? 0 : -err : run_all(&asked, &line);
	if (asked.bisects && !err && code && code != -ERR_FAILED)
		code = BISECT_SKIPS;
	free(asked.program.name);
	free(asked.environment.at);
	free(asked.press.at);
	free(asked.data.at);
	return code;
}
