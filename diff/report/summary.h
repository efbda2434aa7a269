/* Text printed at the end of a comparison: what failed, why, and what to do. Lines have 100 columns, whatever the
 * length of paths. */
#pragma once

#include "diff/report/output.h"

/**
 * Print the frames that did not pass, grouped if alike, with the result of each comparison; then what to do; then
 * summary_close.
 * @param report  folder of the page; NULL: none
 * @return 0 or ERR_SYSTEM (reported)
 */
int summary_write(const struct output_run *run, const char *report, FILE *out);

/** Print the last lines: the application's own programs, counts by outcome, the worst frame. @return 0 or ERR_SYSTEM
 * (reported) */
int summary_close(const struct output_run *run, FILE *out);
