/* Writes the result of a comparison as Markdown, for merge requests and CI jobs. */
#pragma once

#include "diff/report/output.h"

/**
 * Write a summary: counts, then the frames that did not pass, what failed in each, and the draw to blame.
 * @param report  folder of the page to link to; NULL: none
 * @param path    appended to if it exists: CI servers provide one file for all steps of a job
 * @return 0 or ERR_SYSTEM (reported)
 */
int markdown_write(const struct output_run *run, const char *report, const char *path);
