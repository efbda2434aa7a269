/* Slurm's view of a job: queried each time, never kept. */
#pragma once

#include "verbs/farm/job.h"

struct slurm_queue {
	uint64_t running, waiting; /* numbers of tasks */
	uint64_t number;           /* the Slurm job of one of these, or of the report; 0: there is none */
	int report;                /* 1 if the report waits or runs */
	unsigned char *holds;      /* [n_tasks + 1]: 1 if the task of that number waits or runs; owned */
	char *failed_starts;       /* "12_3,12_7": tasks that Slurm could not start and holds; "" for none; owned */
};

/** Query which tasks of the job wait or run. @param out zero-initialised @return 0 or ERR_SYSTEM (reported) */
int slurm_read(const struct farm_job *job, struct slurm_queue *out);
void slurm_free(struct slurm_queue *queue);

/**
 * Release tasks that Slurm could not start. If a node dies while a task starts, Slurm requeues the task, with reason
 * "launch_failed_requeued_held", and holds it until somebody releases it. Tasks held on purpose stay held.
 * @return 0 or ERR_SYSTEM (reported)
 */
int slurm_release(const struct slurm_queue *queue);

/** End all of the job's tasks and reports. @return 0 or ERR_SYSTEM (reported) */
int slurm_cancel(const struct farm_job *job);

/**
 * Read how tasks ended: from Slurm's accounting or, without it, from the controller, which forgets soon (MinJobAge).
 * @param words  receives [n_tasks + 1] texts such as "OUT_OF_MEMORY" or "FAILED, signal 9"; NULL if Slurm does not
 *               know. The caller frees each text and the array
 * @return 0 or ERR_SYSTEM (reported)
 */
int slurm_read_ends(const struct farm_job *job, char ***words);

/** Does the cluster accept an array of the job's size? @return 0: yes; ERR_USAGE (no) or ERR_SYSTEM (both reported) */
int slurm_check_size(const struct farm_job *job);
