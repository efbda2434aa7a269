#include "verbs/farm/job.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/part.h"
#include "base/program.h"
#include "capture/format/sidecar.h"

#define DEFAULT_CHUNK 50
#define MAX_TASKS 1000000

static const char *const farm_engine_names[] = { "slurm", "parallel", "make", NULL };

/* --- The command line -------------------------------------------------------------------------------------------- */

static int take_chunk(const struct options_row *row, const char *text, void *out)
{
	uint64_t *chunk = out;
	char *end;

	errno = 0;
	*chunk = strtoull(text, &end, 10);
	if (errno || *text < '0' || *text > '9' || *end || *chunk == 0)
		return err_report(ERR_USAGE, NULL, "--%s takes a number of frames, not '%s'", row->name, text);
	return 0;
}

static int add_sbatch(const struct options_row *row, const char *text, void *out)
{
	struct farm_job *job = out;

	(void)row;
	job->sbatch[job->n_sbatch++] = text;
	return 0;
}

static const struct options_row rows[] = {
	{ "frames", 'f', "LIST", "frames, as in 1-500 or 1-500x5", options_text,
	  .at = offsetof(struct farm_job, frames_text), .is_required = 1 },
	{ "output", 'o', "PATTERN", "file names: ####, %04d, $F4 or {frame} stand for the frame number", options_text,
	  .at = offsetof(struct farm_job, output), .is_required = 1 },
	{ "chunk", 0, "N", "frames in a task, at most (default 50)", take_chunk,
	  .at = offsetof(struct farm_job, chunk) },
	{ "reference", 0, "REF",
	  "reference to score against, as for 'relume diff' (default: frames recorded with --ref)", options_text,
	  .at = offsetof(struct farm_job, reference) },
	{ "gres", 0, "LIST", "resources that each task needs, as gpu:1", options_text,
	  .at = offsetof(struct farm_job, gres) },
	{ "sbatch", 0, "OPTION", "one more option of sbatch, as --sbatch=--partition=night; may be repeated",
	  add_sbatch, .at = 0 },
	{ "local", 0, NULL, "on this machine, even where Slurm is installed", options_flag,
	  .at = offsetof(struct farm_job, is_local) },
	{ "replace", 0, NULL, "cancel the Slurm job that still renders to the same PATTERN, instead of refusing",
	  options_flag, .at = offsetof(struct farm_job, replace) },
	{ "at-end", 0, "COMMAND",
	  "run COMMAND by the shell when all is done, with RELUME_FARM, the job's folder, and RELUME_CODE, 0 where "
	  "all frames are whole and passed",
	  options_text, .at = offsetof(struct farm_job, at_end) },
	{ "for", 0, "ENGINE", "slurm, parallel or make", options_word, .at = offsetof(struct farm_job, asked_engine),
	  .words = farm_engine_names },
};

const struct options_table farm_options = {
	.verb = "farm",
	.head = "usage: relume farm submit TRACE -f FRAMES -o PATTERN [OPTIONS] [-- RENDER-OPTIONS]\n"
		"       relume farm script --for ENGINE TRACE -f FRAMES -o PATTERN [OPTIONS] [-- RENDER-OPTIONS]\n"
		"       relume farm status [--watch[=SECONDS]] FOLDER\n"
		"       relume farm retry|cancel FOLDER\n"
		"\n"
		"Render frames on many machines, as an array job of Slurm; all on this one where Slurm is not "
	        "installed.\n"
		"Every machine must see the trace and the frames under the same names.\n"
		"\n"
		"submit  starts an array job that renders, then a job that scores and writes a page; prints their "
	        "numbers and the\n"
		"        job's FOLDER, which lies beside the frames: out/gears.farm for out/gears.####.exr. Refuses "
	        "while an\n"
		"        earlier job renders there\n"
		"script  prints what submit would run, for slurm, parallel (GNU parallel) or make; its head says how "
	        "to use it\n"
		"status  says which frames are whole, what waits and runs, how fast, and which tasks failed, why and "
	        "where their\n"
		"        logs are; exits with 1 while frames are missing. With --watch it goes on until nothing waits "
	        "or runs, a\n"
		"        line each 10 SECONDS\n"
		"retry   renders frames that are missing or damaged and that no task waits or runs for, and scores "
	        "again\n"
		"cancel  ends what waits and runs; frames that are whole stay\n",
	OPTIONS_ROWS(rows),
	.notes = "Exit codes: 0 done, 1 frames are missing or did not pass, 2 wrong usage, 3 the trace or the job "
	         "cannot be read,\n"
		 "5 Slurm or the system failed.\n",
	.takes = "one TRACE, -f FRAMES and -o PATTERN",
	.least = 1,
	.most = 1,
};

/* The value of an option of `relume render`; the last one if it is given several times. NULL: it is not given */
static const char *render_option(const struct farm_job *job, const char *option)
{
	const size_t n = strlen(option);
	const char *value = NULL;

	for (int i = 0; i < job->n_render; i++) {
		const char *word = job->render[i];

		if (strncmp(word, option, n) == 0 && word[n] == '=')
			value = word + n + 1;
		else if (strcmp(word, option) == 0 && i + 1 < job->n_render)
			value = job->render[i + 1];
	}
	return value;
}

/* Options that the farm itself gives to `relume render` must not come after the "--". */
static int check_render_options(const struct farm_job *job)
{
	static const char *const ours[] = { "-f", "--frames", "-o", "--output", "--chunk", "--force", "--dry-run" };

	for (int i = 0; i < job->n_render; i++)
		for (size_t k = 0; k < sizeof(ours) / sizeof(ours[0]); k++) {
			size_t n = strlen(ours[k]);

			if (strncmp(job->render[i], ours[k], n) == 0 &&
			    (n == 2 || job->render[i][n] == '\0' || job->render[i][n] == '='))
				return err_report(ERR_USAGE, NULL, "%s does not belong after '--': the farm divides the frames itself",
				                  ours[k]);
		}
	return 0;
}

int farm_job_rehearse(const struct farm_job *job, const char *option, char **text)
{
	char **argv = calloc((size_t)job->n_render + 12, sizeof(*argv));
	int n = 0, rc;

	if (!argv)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	argv[n++] = (char *)job->relume;
	argv[n++] = "render";
	for (int i = 0; i < job->n_render; i++)
		argv[n++] = job->render[i];
	argv[n++] = "-f";
	argv[n++] = (char *)job->frames_text;
	argv[n++] = "-o";
	argv[n++] = (char *)job->output;
	if (option)
		argv[n++] = (char *)option;
	argv[n++] = "--dry-run";
	argv[n++] = "--";
	argv[n++] = (char *)job->trace;
	rc = program_read(argv, 0, text);
	free(argv);
	/* It has reported the error. */
	return rc <= 0 ? rc : rc <= -ERR_SYSTEM ? -rc : ERR_SYSTEM;
}

/*
 * Find the numbers of the pictures. They are those of the frames, unless an option may number them from 0 on; then
 * `relume render` has to open the trace and list them.
 */
static int number_pictures(struct farm_job *job)
{
	uint64_t number = 0, n = 0;
	int err = 0, is_counted = 1, length;
	char *text = NULL;

	if (render_option(job, "--fps") || render_option(job, "--camera"))
		err = farm_job_rehearse(job, NULL, &text);
	for (char *line = text && !err ? strtok(text, "\n") : NULL; line; line = strtok(NULL, "\n"))
		if (sscanf(line, "frame %" SCNu64 ":", &number) == 1)
			is_counted &= number == n++;
	free(text);
	if (err)
		return err;
	length = n && is_counted ? asprintf(&job->pictures_text, "0-%" PRIu64, n - 1) :
	                           asprintf(&job->pictures_text, "%s", job->frames_text);
	if (length < 0) {
		job->pictures_text = NULL;
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	return frame_list_parse(job->pictures_text, &job->pictures);
}

/* out/gears.####.exr -> out/gears.farm */
static int name_folder(struct farm_job *job)
{
	size_t n = frame_pattern_prefix(job->output);

	while (n && strchr("._-", job->output[n - 1]))
		n--;
	if (snprintf(job->folder, sizeof(job->folder), "%.*s%sfarm", (int)n, job->output,
	             n && job->output[n - 1] != '/' ? "." : "") >= (int)sizeof(job->folder))
		return err_report(ERR_USAGE, job->output, "the name is too long");
	return 0;
}

/* Find this executable and the current directory. */
static int find_places(struct farm_job *job)
{
	ssize_t n = readlink("/proc/self/exe", job->relume, sizeof(job->relume) - 1);

	if (n < 0 || !getcwd(job->directory, sizeof(job->directory)))
		return err_report(ERR_SYSTEM, NULL, "cannot find this command or the current directory: %s", strerror(errno));
	job->relume[n] = '\0';
	return 0;
}

/* The trace's name if recorded references are in NAME.ref beside it, where `relume diff` finds them; else NULL. */
static const char *recorded_reference(const struct farm_job *job)
{
	char name[PATH_MAX];

	return sidecar_name(name, sizeof(name), job->trace, ".ref") && access(name, R_OK) == 0 ? job->trace : NULL;
}

/* Only channels gl.*, from the recorded camera, can be scored. @return NULL if they are written, else why not */
static const char *why_unscored(const struct farm_job *job)
{
	const size_t n = strlen(job->output);
	const char *aov = render_option(job, "--aov");

	if (n < 4 || strcmp(job->output + n - 4, ".exr") != 0)
		return "only .exr holds the channels gl.* that can be";
	if (aov && !strstr(aov, "gl"))
		return "--aov leaves out the channels gl.* that could be";
	if (render_option(job, "--camera"))
		return "--camera shows what the program did not";
	if (render_option(job, "--fps"))
		return "--fps shows moments that the program did not";
	return NULL;
}

static int parse_words(struct farm_job *job)
{
	struct options_line line;
	int argc = job->n_words, err;

	/* Do not sort the words after the first "--". */
	for (int i = 1; i < argc; i++)
		if (strcmp(job->words[i], "--") == 0) {
			job->render = job->words + i + 1;
			job->n_render = argc - i - 1;
			argc = i;
			break;
		}
	err = options_parse(&farm_options, argc, job->words, job, &line);
	if (err)
		return err;
	job->trace = line.words[0];
	if (job->asked_engine >= 0)
		job->engine = (enum farm_engine)job->asked_engine;
	else
		job->engine = job->is_local || !program_exists("sbatch") ? FARM_LOCAL : FARM_SLURM;
	return 0;
}

int farm_job_parse(int argc, char **argv, struct farm_job *out)
{
	int err;

	out->chunk = DEFAULT_CHUNK;
	out->asked_engine = -1;
	out->words = calloc((size_t)argc + 1, sizeof(*out->words));
	out->sbatch = calloc((size_t)argc + 1, sizeof(*out->sbatch));
	if (!out->words || !out->sbatch)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (out->n_words = 0; out->n_words < argc; out->n_words++)
		if (!(out->words[out->n_words] = strdup(argv[out->n_words])))
			return err_report(ERR_SYSTEM, NULL, "out of memory");
	err = parse_words(out);
	if (!err)
		err = check_render_options(out);
	if (!err)
		err = find_places(out);
	if (!err)
		err = number_pictures(out);
	if (!err && !frame_pattern_has_number(out->output))
		err = err_report(ERR_USAGE, NULL,
		                 "'%s' holds no place for the frame number (####, %%04d, $F4 or {frame})", out->output);
	if (!err && frame_list_last(&out->pictures) == UINT64_MAX)
		err = err_report(ERR_USAGE, NULL,
		                 "'%s' has no end; tasks need one, as in 55-499 ('relume info' counts frames)",
		                 out->frames_text);
	if (err)
		return err;
	out->n_pictures = frame_list_count(&out->pictures, UINT64_MAX);
	out->n_tasks = out->n_pictures / out->chunk + (out->n_pictures % out->chunk != 0);
	if (out->n_tasks > MAX_TASKS)
		return err_report(ERR_USAGE, NULL,
		                  "%" PRIu64 " tasks are more than anybody has nodes for; a larger --chunk makes fewer",
		                  out->n_tasks);
	if (!out->reference && (out->reference = recorded_reference(out)) && (out->unscored = why_unscored(out)))
		out->reference = NULL;
	if (out->at_end && out->asked_engine == FARM_MAKE)
		return err_report(ERR_USAGE, NULL,
		                  "--at-end does not go with --for make: put the command behind make's, as in 'make -f "
		                  "FILE; COMMAND'");
	return name_folder(out);
}

void farm_job_free(struct farm_job *job)
{
	for (int i = 0; i < job->n_words; i++)
		free(job->words[i]);
	free(job->words);
	free(job->sbatch);
	free(job->pictures_text);
	frame_list_free(&job->pictures);
	*job = (struct farm_job){ 0 };
}

int farm_job_save(const struct farm_job *job)
{
	char path[PATH_MAX + 16];
	struct part_file file;
	int err = folder_make(job->folder);

	snprintf(path, sizeof(path), "%s/arguments", job->folder);
	if (!err)
		err = part_open(&file, path);
	if (err)
		return err;
	fwrite(job->directory, 1, strlen(job->directory) + 1, file.stream);
	/* getopt_long may have sorted the words, which keeps their meaning. */
	for (int i = 0; i < job->n_words; i++)
		fwrite(job->words[i], 1, strlen(job->words[i]) + 1, file.stream);
	return part_close(&file, 0);
}

/* Read a file, and append a NUL that *size does not count. @return its text, freed by the caller, or NULL */
static char *read_arguments(const char *path, size_t *size)
{
	FILE *file = fopen(path, "r");
	char *text = NULL;
	long n;

	if (file && fseek(file, 0, SEEK_END) == 0 && (n = ftell(file)) > 0 && (text = calloc((size_t)n + 1, 1))) {
		rewind(file);
		*size = fread(text, 1, (size_t)n, file);
		if (ferror(file)) {
			free(text);
			text = NULL;
		}
	}
	if (file)
		fclose(file);
	return text;
}

int farm_job_load(const char *folder, struct farm_job *out)
{
	char path[PATH_MAX + 16], wanted[PATH_MAX], found[PATH_MAX];
	size_t size = 0, n = 0;
	char *text, **argv;
	int err = 0;

	snprintf(path, sizeof(path), "%s/arguments", folder);
	text = read_arguments(path, &size);
	if (!text || !realpath(folder, wanted)) {
		free(text);
		return err_report(ERR_INPUT, folder, "is no job of 'relume farm submit'");
	}
	argv = calloc(size + 1, sizeof(*argv));
	if (!argv) {
		free(text);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	/* The first word is the directory. */
	for (char *p = text + strlen(text) + 1; p < text + size; p += strlen(p) + 1)
		argv[n++] = p;
	if (chdir(text) != 0)
		err = err_report(ERR_INPUT, text, "%s; the job was submitted there", strerror(errno));
	if (!err)
		err = farm_job_parse((int)n, argv, out);
	if (!err && (!realpath(out->folder, found) || strcmp(found, wanted) != 0))
		err = err_report(ERR_INPUT, folder, "was made as %s/%s and has been moved", text, out->folder);
	free(argv);
	free(text);
	return err > 0 ? ERR_INPUT : err;
}

uint64_t farm_job_task_of(const struct farm_job *job, uint64_t picture)
{
	return frame_list_contains(&job->pictures, picture) ?
	               frame_list_part_of(&job->pictures, UINT64_MAX, picture, job->n_tasks) :
	               0;
}
