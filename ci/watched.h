/*
 * The inputs of a recording, as far as they are known without running the program: the recorder, the program, the
 * libraries that the loader lists for it, the files that its arguments name, those of `data`, the environment, the
 * keys, and the number of frames. Files are compared by content. If an argument is a script or a program (as with env,
 * wine or a wrapper), its interpreter or libraries are inputs as well.
 *
 * Other files that the program opens (drivers, plug-ins, files named in other files) are not watched.
 */
#pragma once

#include <stddef.h>

#include "ci/plan.h"

struct watched {
	char *text;       /* one line for each input: "file HASH PATH", ...; owned */
	size_t n_files;
	char *not_watched; /* folders among the arguments, separated by commas; owned; NULL: none */
	int is_unknown;   /* 1: the loader did not list a program's libraries, so nothing proves them unchanged */
};

/**
 * Collect all inputs.
 * @param program  path of the executable
 * @param out      all zero; free with watched_free in any case
 * @return 0, ERR_INPUT (reported: `data` names nothing, or a file cannot be read) or ERR_SYSTEM (reported)
 */
int watched_collect(const struct ci_program *p, const char *program, struct watched *out);
void watched_free(struct watched *w);

/**
 * Compare with the inputs kept from the last recording.
 * @param why, size  receive the first change, "model.obj has changed and 2 more"
 * @return 1: something changed, or nothing is kept; 0: all inputs are the same
 */
int watched_changed(const struct watched *w, const char *kept, char *why, size_t size);

/** Keep the inputs for the next run. @return 0 or ERR_SYSTEM (reported) */
int watched_keep(const struct watched *w, const char *kept);
