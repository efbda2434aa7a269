#include "verbs/farm/census.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/err.h"
#include "base/memory.h"

/* "frame 7: out/gears.0007.exr: leave", as printed by `relume render --dry-run`. */
static int count_line(const struct farm_job *job, const char *line, struct census *c, size_t *room)
{
	enum census_verdict found = CENSUS_MISSING;
	uint64_t frame = 0;
	const char *verdict = line;

	if (sscanf(line, "frame %" SCNu64 ":", &frame) != 1)
		return 0;
	for (const char *p = line; (p = strstr(p, ": ")); p += 2)
		verdict = p + 2;
	if (strcmp(verdict, "leave") == 0) {
		c->whole++;
		return 0;
	}
	if (strstr(verdict, "damaged"))
		found = CENSUS_DAMAGED;
	else if (strstr(verdict, "other settings"))
		found = CENSUS_OUTDATED;
	if (MEMORY_GROW(c->wanting, *room, c->n_wanting + 1))
		return ERR_SYSTEM;
	c->wanting[c->n_wanting++] = (struct census_frame){ frame, found };
	c->counts[found]++;
	c->needs[farm_job_task_of(job, frame)] = 1;
	return 0;
}

int census_take(const struct farm_job *job, struct census *out)
{
	char *text = NULL;
	size_t room = 0;
	int rc;

	*out = (struct census){ .needs = calloc(job->n_tasks + 1, 1), .taken = time(NULL) };
	if (!out->needs)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	rc = farm_job_rehearse(job, "--skip-existing", &text);
	for (char *line = rc == 0 ? strtok(text, "\n") : NULL; line && !rc; line = strtok(NULL, "\n"))
		rc = count_line(job, line, out, &room);
	free(text);
	return rc;
}

void census_free(struct census *c)
{
	free(c->wanting);
	free(c->needs);
	*c = (struct census){ 0 };
}

/* When a file was written; 0: there is none. */
static double changed(const char *path)
{
	struct stat st;

	return stat(path, &st) ? 0 : (double)st.st_mtim.tv_sec + 1e-9 * (double)st.st_mtim.tv_nsec;
}

/* When a frame's file was written; 0: there is none. */
static double written(const struct farm_job *job, uint64_t frame)
{
	char path[PATH_MAX];

	return frame_pattern_expand(job->output, frame, path, sizeof(path)) ? 0 : changed(path);
}

uint64_t census_landed(const struct farm_job *job, const struct census *c)
{
	uint64_t n = 0;

	for (size_t i = 0; i < c->n_wanting; i++)
		n += written(job, c->wanting[i].frame) >= (double)c->taken;
	return n;
}

/* When the first task of the last submission began: submissions rewrite job.sh, which touches a lock in each task. */
static double began(const struct farm_job *job)
{
	char path[PATH_MAX + 48];
	double submitted, first = 0, at;

	snprintf(path, sizeof(path), "%s/job.sh", job->folder);
	submitted = changed(path);
	for (uint64_t i = 1; submitted > 0 && i <= job->n_tasks; i++) {
		snprintf(path, sizeof(path), "%s/lock/%" PRIu64, job->folder, i);
		at = changed(path);
		if (at >= submitted && (first == 0 || at < first))
			first = at;
	}
	return first > 0 ? first : submitted;
}

double census_rate(const struct farm_job *job)
{
	const double start = began(job);
	double last = start;
	uint64_t frame = 0, n = 0;

	for (uint64_t from = 0; start > 0 && frame_list_next(&job->pictures, from, &frame); from = frame + 1) {
		const double at = written(job, frame);

		n += at >= start;
		last = at > last ? at : last;
	}
	return last > start ? (double)n / (last - start) : 0;
}
