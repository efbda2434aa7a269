/* What Slurm knows of a job: asked each time, never kept. */
#pragma once

#include "farm/job.h"

struct slurm_queue {
	uint64_t running, waiting; /* tasks */
	uint64_t number;           /* of the Slurm job that one of these, or the report, belongs to; 0: there is none */
	int report;                /* 1 where the report waits or runs */
	unsigned char *holds;      /* [n_tasks + 1]: whether the task of that number waits or runs; owned */
	char *failed_starts;       /* "12_3,12_7": tasks that Slurm could not start and holds; "" for none; owned */
};

/** Ask which tasks of the job wait or run. @param out zero-initialised @return 0 or ERR_SYSTEM (reported) */
int slurm_read(const struct farm_job *job, struct slurm_queue *out);
void slurm_free(struct slurm_queue *queue);

/**
 * Release tasks that Slurm could not start. When a node dies at that moment, Slurm puts the task back as
 * "launch_failed_requeued_held" and waits for a person. Tasks that somebody held on purpose stay held.
 * @return 0 or ERR_SYSTEM (reported)
 */
int slurm_release(const struct slurm_queue *queue);

/** End all of the job's tasks and reports. @return 0 or ERR_SYSTEM (reported) */
int slurm_cancel(const struct farm_job *job);

/**
 * How tasks ended, by Slurm's accounting; where there is none, by what the controller still remembers (MinJobAge).
 * @param words  [n_tasks + 1] texts as "OUT_OF_MEMORY" or "FAILED, signal 9"; NULL where Slurm does not know. Each text and the
 *               array are the caller's
 * @return 0 or ERR_SYSTEM (reported)
 */
int slurm_read_ends(const struct farm_job *job, char ***words);

/** Does the cluster take an array of so many tasks? @return 0, ERR_USAGE or ERR_SYSTEM (reported) */
int slurm_check_size(const struct farm_job *job);
