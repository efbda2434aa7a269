/*
 * A job: frames of a trace, cut into tasks for the machines of a farm.
 *
 * A job has a folder beside its frames: out/gears.####.exr has out/gears.farm. It holds
 *
 *     arguments    the working directory and the words of `relume farm submit`, each ended by NUL. All the rest is
 *                  derived from these
 *     job.sh       the script that the engine runs (script.h)
 *     slurm        one line for each submission and retry: the numbers of the Slurm array job and report job, or "-"
 *     lock/, log/  a file for each task, and for the run and the report
 *     report/      the page of `relume diff`; scores.json: the same as JSON
 *
 * Progress is never written down, so nothing here can disagree with it: the frames show what is done (`relume render
 * --skip-existing --dry-run`), and Slurm knows what waits and runs. Logs only explain why a frame is missing.
 *
 * Pictures have the numbers of the frames that they show, or, with --fps and for turntables, numbers of their own. In
 * `relume farm` both are called frames.
 */
#pragma once

#include <limits.h>
#include <stdint.h>

#include "base/frames.h"
#include "base/options.h"

/* Renders all tasks: an array job of Slurm, GNU parallel, make, or a single `relume render` on this machine. */
enum farm_engine { FARM_SLURM, FARM_PARALLEL, FARM_MAKE, FARM_LOCAL };

struct farm_job {
	/* As typed; strings are borrowed from `words`. Relative names are relative to `directory`. */
	const char *trace, *output, *frames_text;
	const char *reference; /* REF of `relume diff`, to score pictures against; NULL: nothing is scored */
	const char *unscored;  /* why the recorded references are unused; NULL: they are used, or there are none */
	const char *at_end;    /* shell command to run when all tasks and the report are done; NULL: none */
	const char *gres;      /* generic resources a task asks Slurm for, or NULL */
	const char **sbatch;   /* [n_sbatch] further options of sbatch; the array is owned */
	int n_sbatch;
	char **render;         /* [n_render] options of `relume render`; part of `words` */
	int n_render;

	uint64_t chunk;        /* most pictures in a task */
	int is_local;          /* 1: do not use Slurm, even if it is installed */
	int replace;           /* 1: cancel an earlier job that still renders to `output` */
	int asked_engine;      /* --for, an enum farm_engine; -1: not given */

	/* Derived. */
	enum farm_engine engine;
	char *pictures_text;        /* list of the pictures' numbers, which are in their file names; owned */
	struct frame_list pictures; /* pictures_text, parsed; owned */
	uint64_t n_pictures;
	uint64_t n_tasks;           /* n_pictures / chunk, rounded up */

	char directory[PATH_MAX]; /* the working directory of `submit`; absolute */
	char relume[PATH_MAX];    /* this executable; absolute */
	char folder[PATH_MAX];    /* the job's folder, relative to directory or absolute */
	char **words;             /* [n_words] the command line from `submit` on; owned */
	int n_words;
};

/** The options of `relume farm submit` and `relume farm script`. */
extern const struct options_table farm_options;

/**
 * Parse the command line of `submit` or `script`, typed in the current directory. If pictures may have numbers of their
 * own, this runs `relume render --dry-run` to count them.
 * @param argv  from the word `submit` or `script` on; copied
 * @param out   zero-initialised; free with farm_job_free in any case
 * @return 0; 1 if help was printed; or ERR_* (reported)
 */
int farm_job_parse(int argc, char **argv, struct farm_job *out);
void farm_job_free(struct farm_job *job);

/** Create the job's folder and write `arguments` into it. @return 0 or ERR_SYSTEM (reported) */
int farm_job_save(const struct farm_job *job);

/**
 * Load a job from its folder. Changes the process's working directory to that of `submit`.
 * @param out  as for farm_job_parse
 * @return 0 or ERR_* (reported)
 */
int farm_job_load(const char *folder, struct farm_job *out);

/**
 * Run `relume render --dry-run` for all pictures of the job.
 * @param option  one more option, or NULL
 * @param text    receives its lines, one for each picture; owned by the caller
 * @return 0 or ERR_* (reported)
 */
int farm_job_rehearse(const struct farm_job *job, const char *option, char **text);

/** The number, from 1, of the task that renders a picture; 0: none does. @param picture  its number */
uint64_t farm_job_task_of(const struct farm_job *job, uint64_t picture);
