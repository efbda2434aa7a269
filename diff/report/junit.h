/* The outcome of a comparison as JUnit XML, as Jenkins, GitLab and others read it. */
#pragma once

#include "diff/report/output.h"

/**
 * A suite with one case for each frame: named after the recording and the frame, with the picture's file, and where it
 * did not pass with what failed, in words, and the files to look at.
 * @return 0 or ERR_SYSTEM (reported)
 */
int junit_write(const struct output_run *run, const char *path);
