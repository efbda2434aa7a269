/* Programs of a plan in several processes. */
#pragma once

#include <stddef.h>

#include "ci/steps.h"

enum { CI_MOST_JOBS = 1024 };

/**
 * Run programs, each in a process of its own, at most `n_jobs` at a time. What a program and its steps print appears
 * together once it is done, in the order of the plan, on standard output. A single one prints as it goes.
 * @param codes  receives the exit code of each
 * @return 0 or ERR_SYSTEM (reported)
 */
int jobs_run(const struct ci_run *run, const struct ci_program *const *programs, size_t n, size_t n_jobs, int *codes);

/** How many at a time suit this machine. */
size_t jobs_default(void);
