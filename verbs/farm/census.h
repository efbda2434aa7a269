/* Checks which frames of a job are complete, judged by their files. */
#pragma once

#include <time.h>

#include "verbs/farm/job.h"

enum census_verdict {
	CENSUS_MISSING,
	CENSUS_DAMAGED,
	CENSUS_OUTDATED, /* rendered with other settings */
	N_CENSUS_VERDICTS
};

struct census_frame {
	uint64_t frame;
	enum census_verdict verdict;
};

struct census {
	uint64_t whole, counts[N_CENSUS_VERDICTS]; /* numbers of frames */
	struct census_frame *wanting; /* those that are not whole, in rising order; owned */
	size_t n_wanting;
	unsigned char *needs; /* [n_tasks + 1]: 1 if the task of that number still has a frame to render; owned */
	time_t taken;         /* when the frames were checked */
};

/** Read every frame. Also checks all options that tasks will get. @return 0 or ERR_* (reported); free in any case */
int census_take(const struct farm_job *job, struct census *out);
void census_free(struct census *census);

/** Number of frames that were not whole but have been written since. */
uint64_t census_landed(const struct farm_job *job, const struct census *census);

/**
 * The rate of frames written since the first task of the last submission began, by the times of their files. The time
 * that tasks need to start counts, so that frames of one task that appear together do not distort it.
 * @return frames a second; 0: not known yet
 */
double census_rate(const struct farm_job *job);
