#include "verbs/farm/task.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void task_log(const struct farm_job *job, const char *name, char *out, size_t size)
{
	snprintf(out, size, "%s/log/%s", job->folder, name);
}

/* Errors from Relume, Slurm or the shell; the rest is progress. */
static int is_error(const char *line)
{
	static const char *const starts[] = { "relume: ", "slurmstepd: ", "slurmd", "sh: ", "/" };

	for (size_t i = 0; i < sizeof(starts) / sizeof(starts[0]); i++)
		if (strncmp(line, starts[i], strlen(starts[i])) == 0)
			return strstr(line, ": warning: ") == NULL;
	return 0;
}

void task_read(const struct farm_job *job, const char *name, struct task_story *out)
{
	char path[PATH_MAX + 32], *line = NULL;
	size_t room = 0;
	int has_error = 0;
	FILE *file;

	*out = (struct task_story){ 0 };
	task_log(job, name, path, sizeof(path));
	file = fopen(path, "r");
	while (file && getline(&line, &room, file) >= 0) {
		int is_ours = strncmp(line, "farm: ", 6) == 0;

		line[strcspn(line, "\n")] = '\0';
		if (is_ours && strstr(line, " begins")) {
			*out = (struct task_story){ .state = TASK_BEGUN };
			has_error = 0;
		} else if (is_ours && sscanf(line, "farm: %*s %*s ends with %d", &out->code) == 1) {
			out->state = TASK_ENDED;
		} else if (*line && (is_error(line) || !has_error)) {
			has_error |= is_error(line);
			snprintf(out->last, sizeof(out->last), "%s", line);
		}
	}
	free(line);
	if (file)
		fclose(file);
}
