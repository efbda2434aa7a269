/*
 * A job: frames of a trace, cut into tasks for the machines of a farm.
 *
 * A job has a folder beside its frames: out/gears.####.exr has out/gears.farm. It holds
 *
 *     arguments   the working directory and the words of `relume farm submit`, each ended by NUL: the only state
 *     job.sh      the script that the engine runs, made from them (script.h)
 *     slurm       the numbers of its Slurm jobs, one line for each submission and retry: array job, report job or "-"
 *     lock/, log/ of each task; report/, scores.json
 *
 * Progress is never written down. The frames show what is done (`relume render --skip-existing --dry-run`), and Slurm
 * knows what waits and runs. Nothing here can disagree with them. Logs are asked only why a frame is missing.
 */
#pragma once

#include <limits.h>
#include <stdint.h>

#include "base/frames.h"
#include "base/options.h"

enum farm_engine { FARM_SLURM, FARM_PARALLEL, FARM_MAKE, FARM_LOCAL };

struct farm_job {
	/* As typed; borrowed from `words`. Relative names start at `directory`. */
	const char *trace, *output, *frames_text;
	const char *reference; /* reference that the report scores against; NULL: nothing is scored */
	const char *unscored;  /* why the recorded references are unused; NULL: they are used, or there are none */
	const char *at_end;    /* a command of the shell that runs when all is done; NULL */
	const char *gres;      /* generic resources a task asks Slurm for, or NULL */
	const char **sbatch;   /* owned array of n_sbatch further options of sbatch */
	int n_sbatch;
	char **render;         /* n_render options of `relume render` */
	int n_render;

	uint64_t chunk;        /* frames in a task, at most */
	int is_local;          /* 1: --local */
	int replace;           /* 1: --replace */
	int asked_engine;      /* --for, an enum farm_engine; -1: not given */

	enum farm_engine engine;
	char *pictures_text;        /* the numbers in file names: frames_text, or those of pictures with numbers of their
	                               own (--fps, a turntable); owned */
	struct frame_list frames;   /* pictures_text, parsed; owned */
	uint64_t n_frames, n_tasks; /* n_tasks: as many as it takes for no task to exceed `chunk` */

	char directory[PATH_MAX]; /* directory of the command line; absolute */
	char relume[PATH_MAX];    /* this command; absolute */
	char folder[PATH_MAX];    /* the job's folder, relative to directory or absolute */
	char **words;             /* owned; argv of submit without its first word */
	int n_words;
};

/** The options of `relume farm submit` and `relume farm script`. */
extern const struct options_table farm_options;

/**
 * Make a job from the words after `submit` or `script`, in the current directory. Where pictures have numbers of their
 * own, the trace is asked for them.
 * @param out  zero-initialised; free with farm_job_free in any case
 * @return 0, 1 where help was printed, or ERR_* (reported)
 */
int farm_job_parse(int argc, char **argv, struct farm_job *out);
void farm_job_free(struct farm_job *job);

/** Keep the words in the job's folder, which is made. @return 0 or ERR_SYSTEM (reported) */
int farm_job_save(const struct farm_job *job);

/** Find a job by its folder, and go to the directory where it was submitted. @return 0 or ERR_* (reported) */
int farm_job_load(const char *folder, struct farm_job *out);

/**
 * Run `relume render --dry-run` for the whole job.
 * @param option  one more option, or NULL
 * @param text    receives its lines, one for each picture; owned by the caller
 * @return 0 or ERR_* (reported)
 */
int farm_job_rehearse(const struct farm_job *job, const char *option, char **text);

/** The number, from 1, of the task that a frame belongs to; 0 if the job does not have it. */
uint64_t farm_job_task_of(const struct farm_job *job, uint64_t frame);
