/* How a task of Slurm ended, by its log. job.sh writes a line there when a task begins and one when it ends
 * (script.h). */
#pragma once

#include "verbs/farm/job.h"

enum { TASK_LINE_BYTES = 400 };

enum task_state { TASK_UNBEGUN, TASK_BEGUN, TASK_ENDED };

struct task_story {
	enum task_state state;      /* BEGUN and in no queue: killed with the script around it */
	int code;                   /* ENDED: its exit code; above 128 it is a signal's */
	char last[TASK_LINE_BYTES]; /* the last error since it began, else its last line; "": none */
};

/** The log's path. @param name  a task's number, or "report" */
void task_log(const struct farm_job *job, const char *name, char *out, size_t size);

/** Read a log, from the last start of the task. */
void task_read(const struct farm_job *job, const char *name, struct task_story *out);
