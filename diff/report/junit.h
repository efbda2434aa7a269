/* Writes the result of a comparison as JUnit XML, for Jenkins, GitLab and others. */
#pragma once

#include "diff/report/output.h"

/**
 * Write a suite with one case for each frame: named after the recording and the frame, with the picture's file. A frame
 * that did not pass also lists what failed and the files to look at.
 * @return 0 or ERR_SYSTEM (reported)
 */
int junit_write(const struct output_run *run, const char *path);
