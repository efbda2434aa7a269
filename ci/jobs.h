/* Runs the programs of a plan, several at a time. */
#pragma once

#include <stddef.h>

#include "ci/steps.h"

enum { CI_MOST_JOBS = 1024 };

/**
 * Run programs, each in a process of its own, at most `n_jobs` at a time. The output of a program and its steps is
 * printed to standard output when the program is done, in the order of the plan. With one program, or one job at a
 * time, output is not delayed.
 * @param codes  receives each program's exit code
 * @return 0 or ERR_SYSTEM (reported)
 */
int jobs_run(const struct ci_run *run, const struct ci_program *const *programs, size_t n, size_t n_jobs, int *codes);

/** The default number of jobs: that of this machine's processor cores. */
size_t jobs_default(void);
