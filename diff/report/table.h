/* The full table of `relume diff --table`: wide, for readers who know the gates. */
#pragma once

#include "diff/report/output.h"

/**
 * Print a line for each frame, those that did not pass first, with failing figures and their bars; gates not measured;
 * a legend; a summary.
 * @return 0, or ERR_SYSTEM (reported): out of memory for parts of it
 */
int table_write(const struct output_run *run, FILE *out);
