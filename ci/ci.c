/* relume ci: record programs, render what they drew, and gate the frames: what a continuous integration runs. */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/options.h"
#include "base/verbs.h"
#include "ci/plan.h"
#include "ci/steps.h"

struct texts {
	char **at; /* owned; the texts are borrowed */
	size_t n, room;
};

struct asked {
	const char *file, *kept, *baseline;
	struct ci_program program; /* of the command line; its name may be that of one of the file */
	struct texts environment, data;
	int when_changed;
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
	{ "name", 'n', "NAME", "the folder of its results (default: the program's name); without PROGRAM: the only one of "
	  "the file to run", take_name, AT(program.name) },
	{ "frames", 'f', "N", "frames to record, from the program's first (default 10)", options_number,
	  AT(program.frames), .most = CI_MOST_FRAMES },
	{ "env", 0, "NAME=VALUE", "set a variable for the program; may be repeated", take_text, AT(environment) },
	{ "when-changed", 0, NULL, "record only where something watched has changed, and say what is watched: the program, "
	  "the libraries that the loader lists, the files that its arguments name, --data, --env and --frames",
	  options_flag, AT(when_changed) },
	{ "data", 0, "FILE", "a file or a folder that the program reads besides; may be repeated", take_text,
	  AT(data) },
	{ "kept", 'k', "DIR", "recordings, frames and results, kept between runs (default: ci)", options_text,
	  AT(kept) },
	{ "baseline", 'b', "DIR", "approved frames, a folder for each program (default: approved)", options_text,
	  AT(baseline) },
	{ "config", 0, "FILE", "tolerances, masks, flaky frames, as in 'relume diff --config'", options_text,
	  AT(program.config) },
	{ "programs", 0, "FILE", "without PROGRAM: what to run (default: relume-ci.yaml)", options_text, AT(file) },
};

static const struct options_table table = {
	.verb = "ci",
	.head = "usage: relume ci [OPTIONS] -- PROGRAM [ARGUMENTS]\n"
	        "       relume ci [OPTIONS]\n"
	        "\n"
	        "Record a program, render its frames, and gate each against what the program itself showed and against\n"
	        "the approved frames. Without PROGRAM: all programs that relume-ci.yaml lists ('relume help ci-file' has its keys).\n"
	        "\n"
	        "The program needs a display; on a server: xvfb-run -a relume ci ...\n"
	        "Frames that are whole and of the same recording, settings and version are not rendered again. DIR/NAME\n"
	        "of --kept holds report/index.html, junit.xml, scores.json and summary.md, whatever the exit code. The\n"
	        "summary goes to the file that GITHUB_STEP_SUMMARY names, where that is set.\n",
	OPTIONS_ROWS(rows),
	.notes = "Exit codes: 0 all passed; 1 a picture changed or is missing; 2 wrong usage; 3 an input cannot be read;\n"
	         "4 frames that nobody has approved yet; 5 a program is missing, ended with an error or showed nothing,\n"
	         "or the system failed. Of several programs, the first of 5, 3, 2, 6, 1, 4 that one of them has.\n",
	.most = -1,
	.stops = 1,
};

/* The worse of two exit codes: what kept a comparison from being made goes before what it found. */
static int worse(int a, int b)
{
	static const int order[] = { 0, -ERR_BASELINE, -ERR_FAILED, -ERR_INCOMPLETE, -ERR_USAGE, -ERR_INPUT,
	                             -ERR_SYSTEM };
	size_t rank_a = 0, rank_b = 0, n = sizeof(order) / sizeof(order[0]);

	while (rank_a < n && order[rank_a] != a)
		rank_a++;
	while (rank_b < n && order[rank_b] != b)
		rank_b++;
	return rank_a > rank_b ? a : b; /* an interrupted step has a code of its own */
}

static const char *verdict_of(int code)
{
	return code == 0 ? "passed" : code == -ERR_FAILED ? "failed: pictures have changed"
		: code == -ERR_BASELINE ? "not approved yet" : "could not be compared";
}

static int run_file(const struct asked *asked, struct ci_run *run)
{
	struct ci_plan *plan;
	int err = ci_plan_read(asked->file, &plan), code = 0, *codes = NULL;
	uint32_t n = 0;

	if (!err && !(codes = calloc(plan->n_programs, sizeof(*codes))))
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err && !run->baseline)
		run->baseline = plan->baseline;
	run->baseline = run->baseline ? run->baseline : "approved";
	for (uint32_t i = 0; !err && i < plan->n_programs; i++) {
		if (asked->program.name && strcmp(asked->program.name, plan->programs[i].name) != 0)
			continue;
		codes[i] = ci_run_program(run, &plan->programs[i]);
		code = worse(code, codes[i]);
		n++;
	}
	if (!err && n == 0)
		err = err_report(ERR_USAGE, asked->file, "there is no program '%s'", asked->program.name);
	for (uint32_t i = 0; !err && n > 1 && i < plan->n_programs; i++)
		printf("%s: %s\n", plan->programs[i].name, verdict_of(codes[i]));
	free(codes);
	ci_plan_free(&plan);
	return err ? -err : code;
}

static int run_all(struct asked *asked, const struct options_line *line)
{
	struct ci_program *p = &asked->program;
	char self[PATH_MAX] = "";
	struct ci_run run = { self, asked->kept, asked->baseline, asked->when_changed };
	int err;

	if (readlink("/proc/self/exe", self, sizeof(self) - 1) < 0)
		return -err_report(ERR_SYSTEM, NULL, "cannot find this command's own path: %s", strerror(errno));
	if (!line->n_words && (p->frames || p->config || asked->environment.n || asked->data.n))
		return -err_report(ERR_USAGE, NULL, "--frames, --config, --env and --data are for a PROGRAM; %s has its own",
		                   asked->file);
	if (!line->n_words)
		return run_file(asked, &run);
	p->command = line->words;
	p->n_command = (uint32_t)line->n_words;
	p->environment = asked->environment.at;
	p->n_environment = (uint32_t)asked->environment.n;
	p->data = asked->data.at;
	p->n_data = (uint32_t)asked->data.n;
	run.baseline = run.baseline ? run.baseline : "approved";
	err = ci_program_check(p, NULL);
	return err ? -err : ci_run_program(&run, p);
}

int ci_main(int argc, char **argv)
{
	struct asked asked = { .file = "relume-ci.yaml", .kept = "ci" };
	struct options_line line;
	int err = options_parse(&table, argc, argv, &asked, &line);
	int code = err ? err > 0 ? 0 : -err : run_all(&asked, &line);

	free(asked.program.name);
	free(asked.environment.at);
	free(asked.data.at);
	return code;
}
