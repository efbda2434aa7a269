/*
 * The programs that 'relume ci' records if its command line names none: relume-ci.yaml, or --programs FILE.
 * Paths are relative to the folder that 'relume ci' runs in. An unknown key is an error, reported with its line.
 *
 * KEYS
 *     baseline: approved          # folder of approved frames; --baseline overrides it; default approved
 *     programs:                   # a list
 *       - name: viewer            # name of its results folder; default: the program's name
 *         command: [./viewer, model.obj] # the program and its arguments
 *         frames: 20              # frames to record, from its first on; default 10
 *         press: [space@10, Left@12-15] # keys, each with the first frame that shows it ('relume record --press')
 *         environment: [LIBGL_ALWAYS_SOFTWARE=1] # variables to set for the program
 *         data: [textures, shaders/phong.vert] # files and folders that it reads but its command does not name;
 *                                 # --when-changed watches them
 *         config: viewer-diff.yaml # tolerances, masks and flaky frames ('relume help diff-file')
 *
 * EXAMPLES
 *     # relume-ci.yaml: two programs
 *     programs:
 *       - { command: [./game], frames: 3 }
 *       - { name: glass, command: [./game, --glass], frames: 3 }
 *
 *     relume ci --xvfb
 */
#pragma once

#include <stdint.h>

enum { CI_FRAMES = 10, CI_MOST_FRAMES = 1000000 }; /* frames to record: the default, the maximum */

struct ci_program {
	char *name;         /* NULL before ci_program_check: not given */
	char **command;     /* the program and its arguments */
	char **environment; /* NAME=VALUE */
	char **press;       /* KEY@FRAME or KEY@FIRST-LAST */
	char **data;        /* files and folders that it reads (watched.h) */
	char *config;       /* NULL: none */
	uint32_t frames;    /* 0 before ci_program_check: not given */
	uint32_t n_command, n_environment, n_press, n_data;
};

struct ci_plan {
	char *baseline; /* NULL: not given */
	struct ci_program *programs;
	uint32_t n_programs;
};

/**
 * Read a file of programs, and check each with ci_program_check. Two programs of one name are an error.
 * @param out  free with ci_plan_free
 * @return 0, ERR_INPUT (reported, with the line) or ERR_SYSTEM (reported)
 */
int ci_plan_read(const char *path, struct ci_plan **out);

/** Free a plan, and set it to NULL. */
void ci_plan_free(struct ci_plan **plan);

/**
 * Fill in the default name, that of the command, and the default number of frames. Check both, and the environment. The
 * name becomes a folder and part of a glob, so it has only letters, digits and . _ + -
 * @param where  the file, for messages; NULL: the command line
 * @return 0; ERR_INPUT, or ERR_USAGE for the command line (reported); ERR_SYSTEM (reported)
 */
int ci_program_check(struct ci_program *program, const char *where);
