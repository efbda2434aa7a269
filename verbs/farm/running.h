/* Lets only one run at a time work on a job's frames; two would overwrite each other's. */
#pragma once

#include "verbs/farm/job.h"

/**
 * Take the job's folder for a new run. Refuses if an earlier one still renders there, and reports which and what to do.
 * @param replace  1: end the earlier run's Slurm jobs first, and wait until they are gone
 * @return 0; ERR_USAGE or ERR_SYSTEM (reported)
 */
int running_claim(const struct farm_job *job, int replace);

/** Find the process that runs the job's script without Slurm. @param out  its number in decimal @return 1; 0: none */
int running_process(const struct farm_job *job, char *out, size_t size);
