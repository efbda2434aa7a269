/* The outcome of a comparison as Markdown: what a merge request or a job shows. */
#pragma once

#include "diff/report/output.h"

/**
 * Write a summary: counts, then frames that did not pass, what failed in each, and the draw that is to blame.
 * @param report  folder of the page, which is linked; NULL: there is none
 * @param path    a file that is there is added to: servers hand out one for all steps of a job
 * @return 0 or ERR_SYSTEM (reported)
 */
int markdown_write(const struct output_run *run, const char *report, const char *path);
