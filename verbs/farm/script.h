/*
 * The script that an engine runs: plain shell, or a Makefile. It uses only `relume render` and `relume diff`.
 * `relume farm script` prints it; `relume farm submit` runs the same one.
 */
#pragma once

#include <stdio.h>

#include "verbs/farm/job.h"

/** Print the script of job->engine. @return 0, or ERR_USAGE (reported) if a word cannot be quoted in it */
int farm_script_print(const struct farm_job *job, FILE *out);

/** Write it as job.sh into the job's folder, whole or not at all. @return 0 or ERR_* (reported) */
int farm_script_save(const struct farm_job *job);
