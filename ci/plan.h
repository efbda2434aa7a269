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

enum { CI_FRAMES = 10, CI_MOST_FRAMES = 1000000 };

struct ci_program {
	char *name;
	char **command;     /* the program and its arguments */
	char **environment; /* NAME=VALUE */
	char **press;       /* KEY@FRAME */
	char **data;
	char *config;       /* NULL: none */
	uint32_t frames;    /* 0 in a file: the default */
	uint32_t n_command, n_environment, n_press, n_data;
};

struct ci_plan {
	char *baseline; /* NULL: not given */
	struct ci_program *programs;
	uint32_t n_programs;
};

/**
 * Read a file, and fill in defaults.
 * @param out  free with ci_plan_free
 * @return 0, ERR_INPUT (reported, with the line) or ERR_SYSTEM (reported)
 */
int ci_plan_read(const char *path, struct ci_plan **out);
void ci_plan_free(struct ci_plan **plan);

/**
 * Check a program, and name it after its command if it has no name. The name becomes a folder and part of a glob.
 * @param where  the file, for messages; NULL: the command line
 * @return 0; ERR_USAGE, or ERR_INPUT for a file (reported)
 */
int ci_program_check(struct ci_program *program, const char *where);
