/* Reads from its log how a task ended: job.sh (script.h) writes a line there when the task begins, and one when it
 * ends. */
#pragma once

#include "verbs/farm/job.h"

enum { TASK_LINE_BYTES = 400 };

enum task_state { TASK_UNBEGUN, TASK_BEGUN, TASK_ENDED };

struct task_story {
	enum task_state state;      /* BEGUN but in no queue: killed together with its script */
	int code;                   /* if ENDED: its exit code; above 128: a signal's number + 128 */
	char last[TASK_LINE_BYTES]; /* the last error since it began, else its last line; "": none */
};

/** The log's path. @param name  a task's number, or "report" */
void task_log(const struct farm_job *job, const char *name, char *out, size_t size);

/** Read a log, from the last start of the task. */
void task_read(const struct farm_job *job, const char *name, struct task_story *out);
