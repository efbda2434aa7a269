/* The whole table of `relume diff --table`: wide, for those who know the gates. */
#pragma once

#include "diff/report/output.h"

/**
 * A line for each frame, those that did not pass first, with failing figures beside their bars; what was not measured;
 * a legend; a summary.
 * @return 0, or ERR_SYSTEM (reported): there was no memory for all of it
 */
int table_write(const struct output_run *run, FILE *out);
