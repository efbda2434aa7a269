/* What a CI server gets besides files: a job's summary, and marks in its log. */
#pragma once

#include "ci/plan.h"

/** 1 where the server reads workflow commands (::error ...::) in the log. */
int server_reads_commands(void);

/** Add a program's summary (Markdown) to the file that the server shows for the whole job, where it names one. */
void server_add_summary(const char *path);

/** Mark a step that failed in the log, where the server reads it. */
void server_mark_failure(const struct ci_program *program, const char *step, int code);
