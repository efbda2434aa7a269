#include "verbs/farm/slurm.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/program.h"

static int ask(char *const *argv, char **out)
{
	int rc = program_read(argv, 0, out);

	if (rc > 0) {
		free(*out);
		*out = NULL;
		return err_report(ERR_SYSTEM, NULL, "%s failed with exit code %d; is Slurm's controller running?", argv[0], rc);
	}
	return rc;
}

/* The numbers of this job's Slurm jobs: pairs of array and report, 0 for none. Freed by the caller. */
static int read_numbers(const struct farm_job *job, uint64_t **out, size_t *n)
{
	char path[PATH_MAX + 16], array[32], report[32];
	uint64_t *numbers = NULL;
	FILE *file;
	int err = 0;

	*out = NULL;
	*n = 0;
	snprintf(path, sizeof(path), "%s/slurm", job->folder);
	file = fopen(path, "r");
	while (file && fscanf(file, "%31s %31s", array, report) == 2) {
		uint64_t *grown = realloc(numbers, (*n + 2) * sizeof(*grown));

		if (!grown) {
			err = err_report(ERR_SYSTEM, NULL, "out of memory");
			break;
		}
		numbers = grown;
		numbers[(*n)++] = strtoull(array, NULL, 10); /* "-" is none */
		numbers[(*n)++] = strtoull(report, NULL, 10);
	}
	if (file && ferror(file))
		err = err_report(ERR_SYSTEM, path, "cannot be read: %s", strerror(errno));
	if (file)
		fclose(file);
	if (err)
		free(numbers);
	else
		*out = numbers;
	return err;
}

int slurm_read(const struct farm_job *job, struct slurm_queue *out)
{
	static char *const squeue[] = { "squeue", "--noheader", "--array", "--me", "--format=%F %K %T %r", NULL };
	uint64_t *numbers, number;
	char task[32], state[32], reason[64], *text = NULL;
	size_t n = 0, used = 0, room;
	int err = read_numbers(job, &numbers, &n);

	if (err)
		return err;
	out->holds = calloc(job->n_tasks + 1, 1);
	err = out->holds ? ask(squeue, &text) : err_report(ERR_SYSTEM, NULL, "out of memory");
	/* A task's name, with its comma, is never longer than its line. */
	room = text ? strlen(text) + 2 : 1;
	out->failed_starts = calloc(room, 1);
	if (!err && !out->failed_starts)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	for (char *line = err ? NULL : strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
		if (sscanf(line, "%" SCNu64 " %31s %31s %63s", &number, task, state, reason) != 4)
			continue;
		for (size_t i = 0; i < n; i++) {
			uint64_t index = strtoull(task, NULL, 10);

			if (numbers[i] != number || number == 0)
				continue;
			out->number = number;
			if (i % 2) {
				out->report = 1;
			} else {
				*(strcmp(state, "PENDING") == 0 ? &out->waiting : &out->running) += 1;
				if (index <= job->n_tasks)
					out->holds[index] = 1;
				if (strstr(reason, "requeued_held"))
					used += (size_t)snprintf(out->failed_starts + used, room - used, "%s%" PRIu64 "_%" PRIu64,
					                         used ? "," : "", number, index);
			}
			break;
		}
	}
	free(text);
	free(numbers);
	return err;
}

/* --- How tasks ended --------------------------------------------------------------------------------------------- */

static int keep_end(const struct farm_job *job, char **words, uint64_t task, const char *state, int signal)
{
	char text[64];

	if (task > job->n_tasks || strcmp(state, "COMPLETED") == 0 || strcmp(state, "RUNNING") == 0 ||
	    strcmp(state, "PENDING") == 0)
		return 0;
	if (signal)
		snprintf(text, sizeof(text), "%s, signal %d", state, signal);
	else
		snprintf(text, sizeof(text), "%s", state);
	free(words[task]); /* later submissions come later */
	words[task] = strdup(text);
	return words[task] ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
}

/* "12_3|OUT_OF_MEMORY|0:125"; a cancelled one is "CANCELLED by 1000". */
static int read_accounting(const struct farm_job *job, char *line, char **words)
{
	uint64_t number, task;
	char state[32];
	int signal;

	if (sscanf(line, "%" SCNu64 "_%" SCNu64 "|%31[A-Z_]%*[^|]|%*d:%d", &number, &task, state, &signal) == 4 ||
	    sscanf(line, "%" SCNu64 "_%" SCNu64 "|%31[A-Z_]|%*d:%d", &number, &task, state, &signal) == 4)
		return keep_end(job, words, task, state, signal);
	return 0;
}

/* "JobId=13 ArrayJobId=12 ArrayTaskId=3 ... JobState=OUT_OF_MEMORY ... ExitCode=0:125 ..." */
static int read_controller(const struct farm_job *job, char *line, char **words)
{
	const char *task = strstr(line, " ArrayTaskId="), *state = strstr(line, " JobState="),
		   *code = strstr(line, " ExitCode=");
	char word[32];
	int signal = 0;

	if (!task || !state || sscanf(state, " JobState=%31[A-Z_]", word) != 1)
		return 0;
	if (code)
		sscanf(code, " ExitCode=%*d:%d", &signal);
	return keep_end(job, words, strtoull(task + strlen(" ArrayTaskId="), NULL, 10), word, signal);
}

int slurm_read_ends(const struct farm_job *job, char ***words)
{
	uint64_t *numbers;
	size_t n = 0;
	int err = read_numbers(job, &numbers, &n);

	*words = NULL;
	if (err)
		return err;
	*words = calloc(job->n_tasks + 1, sizeof(**words));
	if (!*words)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; i < n && !err; i += 2) {
		char number[24], *text = NULL;
		char *sacct[] = { "sacct", "-n", "-P", "-X", "--format=JobID,State,ExitCode", "-j", number, NULL };
		char *scontrol[] = { "scontrol", "-o", "show", "job", number, NULL };
		int has_accounting;

		if (!numbers[i])
			continue;
		snprintf(number, sizeof(number), "%" PRIu64, numbers[i]);
		has_accounting = program_exists("sacct") && program_read(sacct, 1, &text) == 0 && text && *text;
		if (!has_accounting) {
			free(text);
			text = NULL;
			program_read(scontrol, 1, &text); /* the controller forgets jobs: then it is not known */
		}
		for (char *line = text ? strtok(text, "\n") : NULL; line && !err; line = strtok(NULL, "\n"))
			err = has_accounting ? read_accounting(job, line, *words) : read_controller(job, line, *words);
		free(text);
	}
	free(numbers);
	return err;
}

void slurm_free(struct slurm_queue *queue)
{
	free(queue->holds);
	free(queue->failed_starts);
	*queue = (struct slurm_queue){ 0 };
}

int slurm_release(const struct slurm_queue *queue)
{
	char *argv[] = { "scontrol", "release", queue->failed_starts, NULL }, *text;
	int err;

	if (!queue->failed_starts || !*queue->failed_starts)
		return 0;
	err = ask(argv, &text);
	free(text);
	if (!err)
		printf("released %s: Slurm could not start them\n", queue->failed_starts);
	return err;
}

int slurm_cancel(const struct farm_job *job)
{
	uint64_t *numbers;
	char **argv, *text, (*words)[24];
	size_t n = 0, k = 0;
	int err = read_numbers(job, &numbers, &n);

	if (err)
		return err;
	argv = calloc(n + 3, sizeof(*argv));
	words = calloc(n + 1, sizeof(*words));
	if (!argv || !words)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err) {
		argv[k++] = "scancel";
		argv[k++] = "--quiet"; /* about jobs that have ended */
		for (size_t i = 0; i < n; i++)
			if (numbers[i]) {
				snprintf(words[i], sizeof(words[i]), "%" PRIu64, numbers[i]);
				argv[k++] = words[i];
			}
		if (k > 2) {
			err = ask(argv, &text);
			free(text);
		}
	}
	free(words);
	free(argv);
	free(numbers);
	return err;
}

int slurm_check_size(const struct farm_job *job)
{
	static char *const scontrol[] = { "scontrol", "show", "config", NULL };
	char *text = NULL, *found;
	uint64_t most = 0;
	int rc = program_read(scontrol, 1, &text), err = 0;

	if (rc > 0) {
		free(text);
		return err_report(ERR_SYSTEM, NULL,
		                  "Slurm's controller does not answer ('scontrol show config' ends with %d); start it, or go on "
		                  "without: 'relume farm submit --local' renders here, 'relume farm script' prints a script",
		                  rc);
	}
	if (rc)
		return rc;
	found = strstr(text, "MaxArraySize");
	if (found && sscanf(found, "MaxArraySize = %" SCNu64, &most) == 1 && job->n_tasks >= most)
		err = err_report(ERR_USAGE, NULL, "%" PRIu64 " tasks are more than this cluster's arrays hold (%" PRIu64
		                 "); --chunk %" PRIu64 " makes few enough", job->n_tasks, most - 1,
		                 (job->n_pictures + most - 2) / (most - 1));
	free(text);
	return err;
}
