/* Output for CI servers besides files: a summary of the job, and marks in its log. */
#pragma once

#include "ci/plan.h"

/** 1 if the server reads workflow commands (::error ...::) from the log. */
int server_reads_commands(void);

/** Append a program's summary (Markdown) to the file that the server shows for the whole job, if it names one. */
void server_add_summary(const char *path);

/** Mark a failed step in the log, if the server reads such marks. */
void server_mark_failure(const struct ci_program *program, const char *step, int code);
