/* What a person reads at the end of a comparison: what failed, why, and what to do; 100 columns, whatever a path
 * takes. */
#pragma once

#include "diff/report/output.h"

/**
 * Frames that did not pass, those alike together, with what each comparison says; what to do; then summary_close.
 * @param report  folder of the page; NULL: there is none
 * @return 0 or ERR_SYSTEM (reported)
 */
int summary_write(const struct output_run *run, const char *report, FILE *out);

/** The last lines: the application's own programs, counts by outcome, the worst frame. @return 0 or ERR_SYSTEM
 * (reported) */
int summary_close(const struct output_run *run, FILE *out);
