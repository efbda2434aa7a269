#include "verbs/farm/script.h"

#include <inttypes.h>
#include <string.h>

#include "base/err.h"
#include "base/part.h"
#include "base/plural.h"

/* One word of a shell command. In a recipe of make every dollar is written twice. */
static void put_word(const struct farm_job *job, FILE *out, const char *word)
{
	fputc('\'', out);
	for (const char *p = word; *p; p++) {
		if (*p == '\'')
			fputs("'\\''", out);
		else if (*p == '$' && job->engine == FARM_MAKE)
			fputs("$$", out);
		else
			fputc(*p, out);
	}
	fputc('\'', out);
}

static void put_argument(const struct farm_job *job, FILE *out, const char *word)
{
	fputc(' ', out);
	put_word(job, out, word);
}

static void put_option(const struct farm_job *job, FILE *out, const char *option, const char *word)
{
	fprintf(out, " %s", option);
	put_argument(job, out, word);
}

/* A task's command; `task` is its number as the engine writes it, NULL for all of them. Our options come last, and so
 * count. */
static void put_render(const struct farm_job *job, FILE *out, const char *task)
{
	put_word(job, out, job->relume);
	fputs(" render", out);
	for (int i = 0; i < job->n_render; i++)
		put_argument(job, out, job->render[i]);
	put_option(job, out, "-f", job->frames_text);
	put_option(job, out, "-o", job->output);
	if (task)
		fprintf(out, " --chunk %s/%" PRIu64, task, job->n_tasks);
	fputs(" --skip-existing --allow-incomplete -- ", out);
	put_word(job, out, job->trace);
}

static void put_unscored(const struct farm_job *job, FILE *out)
{
	char text[120];

	snprintf(text, sizeof(text), "nothing is scored: %s", job->unscored ? job->unscored : "there are no reference frames");
	put_word(job, out, text);
}

static void put_report(const struct farm_job *job, FILE *out)
{
	char path[PATH_MAX + 16];

	if (!job->reference && job->engine == FARM_SLURM) { /* there for the command at the end alone */
		put_word(job, out, job->relume);
		put_option(job, out, "farm status", job->folder);
		return;
	}
	if (!job->reference) {
		fputs("echo ", out);
		put_unscored(job, out);
		return;
	}
	put_word(job, out, job->relume);
	put_option(job, out, "diff -f", job->pictures_text);
	snprintf(path, sizeof(path), "%s/report", job->folder);
	put_option(job, out, "--report", path);
	snprintf(path, sizeof(path), "%s/scores.json", job->folder);
	put_option(job, out, "--json", path);
	put_option(job, out, "--", job->reference);
	put_argument(job, out, job->output);
}

/* Names in comments: one line each. */
static void put_comment(FILE *out, const char *text)
{
	for (; *text; text++)
		fputc((unsigned char)*text < ' ' ? '?' : *text, out);
}

static void put_head(const struct farm_job *job, FILE *out)
{
	fputs("# relume farm: frames ", out);
	put_comment(out, job->frames_text);
	fputs(" of ", out);
	put_comment(out, job->trace);
	fprintf(out, ", %" PRIu64 " in %" PRIu64 " task%s.\n", job->n_pictures, job->n_tasks, plural(job->n_tasks));
}

static void put_functions(const struct farm_job *job, FILE *out)
{
	fputs("#   sh FILE task N    render the Nth task; frames that are whole are left as they are\n"
	      "#   sh FILE report    score all frames and write a page\n"
	      "set -u\n"
	      "self=$(realpath \"$0\")\n"
	      "cd ", out);
	put_word(job, out, job->directory);
	fputs(" || exit 5\njob=", out);
	put_word(job, out, job->folder);
	fputs("\n"
	      "mkdir -p \"$job/lock\" \"$job/log\" || exit 5\n"
	      "\n"
	      "# One process a task: an engine may start a task again while a machine that it gave up still works on it.\n"
	      "# `relume farm status` reads from the log how it ended. A signal reaches the renderer as well, which ends.\n"
	      "task() {\n"
	      "\ttrap : TERM INT HUP\n"
	      "\techo \"farm: task $1 begins on ${SLURMD_NODENAME-this machine}\"\n"
	      "\ttouch \"$job/lock/$1\"\n"
	      "\tflock -F \"$job/lock/$1\" ", out);
	put_render(job, out, "\"$1\"");
	fputs("\n"
	      "\tset -- \"$1\" $?\n"
	      "\techo \"farm: task $1 ends with $2\"\n"
	      "\texit \"$2\"\n"
	      "}\n\nreport() {\n\t", out);
	put_report(job, out);
	fputs("\n}\n\n# What is to be done with exit code $1, which tells whether all is well.\nat_end() {\n\t", out);
	if (job->at_end) {
		fputs("RELUME_FARM=$job RELUME_CODE=$1 sh -c ", out);
		put_word(job, out, job->at_end);
		fputs("\n\t", out);
	}
	fputs("exit \"$1\"\n}\n\n", out);
}

/* A run on this machine holds lock/run to its end, and writes its process number there. */
static void put_claim(FILE *out)
{
	fputs("exec 9<>\"$job/lock/run\" || exit 5\n"
	      "if ! flock -n 9; then\n"
	      "\tread -r other <&9\n"
	      "\techo \"relume: $job: process $other still renders there: wait for it or end it\" >&2\n"
	      "\texit 2\n"
	      "fi\n"
	      "echo $$ >&9\n", out);
}

static void put_case(FILE *out)
{
	fputs("case ${1-} in\n"
	      "task) task \"${2-${SLURM_ARRAY_TASK_ID-}}\" ;;\n"
	      "report)\n"
	      "\techo 'farm: the report begins'\n"
	      "\treport\n"
	      "\tset -- $?\n"
	      "\techo \"farm: the report ends with $1\"\n"
	      "\tat_end \"$1\" ;;\n"
	      "esac\n", out);
}

/* Ends with the exit code of rendering, or, if that is 0, with the report's. */
static const char both[] = "report\nreported=$?\n[ \"$rendered\" = 0 ] || reported=$rendered\nat_end \"$reported\"\n";

/*
 * After a command: continue when it has ended. A signal that ends the script, by the PID in lock/run, ends the command
 * as well. A terminal's SIGINT reaches both.
 */
static const char wait_for_it[] =
	" &\n"
	"child=$!\n"
	"trap 'kill -TERM \"$child\"' TERM HUP\n"
	"trap : INT\n"
	"wait \"$child\"\n"
	"rendered=$?\n"
	"while kill -0 \"$child\" 2>&-; do\n"
	"\twait \"$child\"\n"
	"\trendered=$?\n"
	"done\n"
	"trap - TERM HUP INT\n"
	"[ \"$rendered\" -lt 128 ] || exit \"$rendered\"\n";

static void put_local(const struct farm_job *job, FILE *out)
{
	fputs("#!/bin/sh\n", out);
	put_head(job, out);
	fputs("#   sh FILE           render and score all, here\n", out);
	put_functions(job, out);
	put_case(out);
	put_claim(out);
	put_render(job, out, NULL);
	fputs(wait_for_it, out);
	fputs(both, out);
}

static void put_parallel(const struct farm_job *job, FILE *out)
{
	fputs("#!/bin/sh\n", out);
	put_head(job, out);
	fputs("#   sh FILE [OPTIONS] render and score all; OPTIONS go to parallel, as -j 4 or --sshlogin HOST\n", out);
	put_functions(job, out);
	put_case(out);
	put_claim(out);
	fprintf(out, "seq 1 %" PRIu64 " | parallel -q \"$@\" sh \"$self\" task {}", job->n_tasks);
	fputs(wait_for_it, out);
	fputs(both, out);
}

/* sbatch expands % in file names, so each one is doubled. */
static void put_slurm_log(const struct farm_job *job, FILE *out, const char *name)
{
	char path[2 * PATH_MAX + 32];
	size_t n = 0;

	for (const char *p = job->folder; *p; p++) {
		path[n++] = *p;
		if (*p == '%')
			path[n++] = '%';
	}
	snprintf(path + n, sizeof(path) - n, "/log/%s", name);
	put_option(job, out, "--open-mode=append --output", path);
}

static void put_sbatch(const struct farm_job *job, FILE *out, const char *log)
{
	const char *slash = strrchr(job->folder, '/');

	fputs("sbatch --parsable", out);
	put_option(job, out, "--job-name", slash ? slash + 1 : job->folder);
	put_slurm_log(job, out, log);
	for (int i = 0; i < job->n_sbatch; i++)
		put_argument(job, out, job->sbatch[i]);
}

static void put_slurm(const struct farm_job *job, FILE *out)
{
	fputs("#!/bin/sh\n", out);
	put_head(job, out);
	fputs("#   sh FILE [TASKS]   hand all (or tasks as 3,17,40-42; or none) to Slurm, and the report after them; "
	      "prints their numbers\n",
	      out);
	put_functions(job, out);
	put_case(out);
	fprintf(out, "tasks=${1-1-%" PRIu64 "} after= array=- report=-\n", job->n_tasks);
	fputs("if [ \"$tasks\" != none ]; then\n\tarray=$(", out);
	put_sbatch(job, out, "%a");
	if (job->gres)
		put_option(job, out, "--gres", job->gres);
	fputs(" --array \"$tasks\" \"$self\" task) || exit 5\n"
	      "\tarray=${array%%;*}\n"
	      "\tafter=--dependency=afterany:$array\n"
	      "\techo \"render $array, tasks $tasks\"\n"
	      "fi\n", out);
	if (!job->reference) {
		fputs("echo ", out);
		put_unscored(job, out);
		fputc('\n', out);
	}
	if (job->reference || job->at_end) {
		fputs("report=$(", out);
		put_sbatch(job, out, "report");
		fputs(" $after \"$self\" report) || { [ \"$array\" = - ] || echo \"$array -\" >>\"$job/slurm\"; exit 5; }\n"
		      "report=${report%%;*}\n", out);
		fprintf(out, "echo \"%s $report\"\n", job->reference ? "report" : "at the end");
	}
	fputs("echo \"$array $report\" >>\"$job/slurm\"\n", out);
}

static void put_make(const struct farm_job *job, FILE *out)
{
	put_head(job, out);
	fputs("#   make -k -j 4 -f FILE          render all tasks, four at once, and score when all are done\n"
	      "#   make -f FILE task-7, report   one of them\n"
	      ".PHONY: all report\n", out);
	fprintf(out, "TASKS := $(addprefix task-,$(shell seq 1 %" PRIu64 "))\n", job->n_tasks);
	fputs(".DEFAULT_GOAL := all\n"
	      ".PHONY: $(TASKS)\n"
	      "\n"
	      "all: $(TASKS)\n"
	      "\t@$(MAKE) -f $(firstword $(MAKEFILE_LIST)) report\n"
	      "\n"
	      "$(TASKS): task-%:\n"
	      "\tcd ", out);
	put_word(job, out, job->directory);
	fputs(" && ", out);
	put_render(job, out, "$*");
	fputs("\n\nreport:\n\tcd ", out);
	put_word(job, out, job->directory);
	fputs(" && ", out);
	put_report(job, out);
	fputc('\n', out);
}

static int has_newline(const struct farm_job *job)
{
	int found = strchr(job->directory, '\n') || strchr(job->relume, '\n');

	for (int i = 0; i < job->n_words; i++)
		found |= strchr(job->words[i], '\n') != NULL;
	return found;
}

int farm_script_print(const struct farm_job *job, FILE *out)
{
	switch (job->engine) {
	case FARM_LOCAL: put_local(job, out); break;
	case FARM_PARALLEL: put_parallel(job, out); break;
	case FARM_SLURM: put_slurm(job, out); break;
	case FARM_MAKE:
		if (has_newline(job))
			return err_report(ERR_USAGE, NULL, "a name holds a line break, which a Makefile cannot say");
		put_make(job, out);
		break;
	}
	return 0;
}

int farm_script_save(const struct farm_job *job)
{
	char path[PATH_MAX + 16];
	struct part_file file;
	int err;

	snprintf(path, sizeof(path), "%s/job.sh", job->folder);
	err = part_open(&file, path);
	return err ? err : part_close(&file, farm_script_print(job, file.stream));
}
