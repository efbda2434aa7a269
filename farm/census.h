/* Which frames of a job are whole: what the files say. */
#pragma once

#include <time.h>

#include "farm/job.h"

enum census_verdict { CENSUS_MISSING, CENSUS_DAMAGED, CENSUS_OUTDATED, N_CENSUS_VERDICTS }; /* OUTDATED: of other settings */

struct census_frame {
	uint64_t frame;
	enum census_verdict verdict;
};

struct census {
	uint64_t whole, counts[N_CENSUS_VERDICTS];
	struct census_frame *wanting; /* those that are not whole, in rising order; owned */
	size_t n_wanting;
	unsigned char *needs; /* [n_tasks + 1]: whether the task of that number has a frame to render; owned */
	time_t taken;
};

/** Look at every frame, and check all that tasks will be given. @return 0 or ERR_* (reported); free in any case */
int census_take(const struct farm_job *job, struct census *out);
void census_free(struct census *census);

/** Frames that were wanting and have a new file since. */
uint64_t census_landed(const struct farm_job *job, const struct census *census);

/**
 * How fast frames come: those written since the first task of the last submission began, by the times of their files.
 * What a task needs to start counts: several frames of one that land together say little of those to come.
 * @return frames a second; 0 where it cannot be known yet
 */
double census_rate(const struct farm_job *job);
