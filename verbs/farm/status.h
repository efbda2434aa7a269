/* relume farm status: what is done, what runs, what failed and why. */
#pragma once

#include "verbs/farm/job.h"

/**
 * Print a job's state.
 * @param interval_s  0: print it once; else print a line at this interval while something waits or runs, and the whole
 *                    state at the end
 * @return 0: all frames are whole; ERR_FAILED: some are not; or another ERR_* (reported)
 */
int status_print(const struct farm_job *job, unsigned interval_s);
