#include "verbs/farm/running.h"

#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/plural.h"
#include "base/program.h"
#include "base/folder.h"
#include "verbs/farm/slurm.h"

enum { PATIENCE_S = 120, LOOKS_A_SECOND = 2 };

/* The script holds lock/run from its first line to the end of its last process (script.c). */
int running_process(const struct farm_job *job, char *out, size_t size)
{
	char path[PATH_MAX + 32];
	int fd, held;
	ssize_t n;

	snprintf(path, sizeof(path), "%s/lock/run", job->folder);
	fd = open(path, O_RDONLY | O_CLOEXEC);
	if (fd < 0)
		return 0;
	held = flock(fd, LOCK_EX | LOCK_NB) != 0;
	n = held ? read(fd, out, size - 1) : 0;
	out[n > 0 ? n : 0] = '\0';
	out[strcspn(out, "\n")] = '\0';
	close(fd);
	return held;
}

static int has_slurm_jobs(const struct farm_job *job)
{
	char path[PATH_MAX + 16];

	snprintf(path, sizeof(path), "%s/slurm", job->folder);
	return access(path, R_OK) == 0 && program_exists("squeue");
}

/* The Slurm job that renders there: 0 for none. Fills `text` with its tasks. */
static int read_slurm(const struct farm_job *job, uint64_t *number, char *text, size_t size)
{
	struct slurm_queue queue = { 0 };
	int err = has_slurm_jobs(job) ? slurm_read(job, &queue) : 0;

	*number = queue.number;
	if (queue.running + queue.waiting)
		snprintf(text, size, "%" PRIu64 " task%s running, %" PRIu64 " waiting", queue.running,
		         plural(queue.running), queue.waiting);
	else
		snprintf(text, size, "its report waits or runs");
	slurm_free(&queue);
	return err;
}

/* End the Slurm jobs and wait, or what they still write would be mistaken for the new job's. */
static int end_slurm(const struct farm_job *job)
{
	const struct timespec pause = { 0, 1000000000 / LOOKS_A_SECOND };
	uint64_t number = 1;
	char text[80];
	int err = slurm_cancel(job);

	for (int i = 0; i < PATIENCE_S * LOOKS_A_SECOND && !err && number; i++) {
		err = read_slurm(job, &number, text, sizeof(text));
		if (!err && number)
			nanosleep(&pause, NULL);
	}
	if (!err && number)
		err = err_report(ERR_SYSTEM, job->folder,
		                 "Slurm job %" PRIu64 " was cancelled but does not end; try again later", number);
	return err;
}

/* Remove an earlier run's files: `farm status` would mistake them for the new one's. */
static void forget_earlier(const struct farm_job *job)
{
	char path[PATH_MAX + 16];

	snprintf(path, sizeof(path), "%s/slurm", job->folder);
	unlink(path);
	snprintf(path, sizeof(path), "%s/log", job->folder);
	if (access(path, F_OK) == 0)
		folder_remove(path);
}

int running_claim(const struct farm_job *job, int replace)
{
	char text[80], process[32];
	uint64_t number = 0;
	int err = read_slurm(job, &number, text, sizeof(text));

	if (!err && number && !replace)
		return err_report(ERR_USAGE, job->folder,
		                  "Slurm job %" PRIu64
		                  " still renders there (%s): 'relume farm status %s' shows it; submit with "
		                  "--replace to cancel it first, or to another -o",
		                  number, text, job->folder);
	if (!err && running_process(job, process, sizeof(process)))
		return err_report(ERR_USAGE, job->folder,
		                  "process %s still renders there: wait for it or end it, or submit to another -o",
		                  process);
	if (!err && number)
		err = end_slurm(job);
	if (!err)
		forget_earlier(job);
	return err;
}
