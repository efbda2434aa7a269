/*
 * What a recording depends on, as far as it can be known without running the program: the recorder, the program, the
 * libraries that the loader lists for it, the files that its arguments name, those of `data`, the environment and the
 * keys given, and the number of frames. Files count by their content. A script's interpreter and a program among the
 * arguments (of env, wine, a wrapper) are followed likewise.
 *
 * What the program opens beyond these (drivers, plug-ins, files named in other files) is not watched.
 */
#pragma once

#include <stddef.h>

#include "ci/plan.h"

struct watched {
	char *text;       /* a line for each thing: "file HASH PATH", ...; owned */
	size_t n_files;
	char *not_watched; /* folders among the arguments, with commas; owned; NULL: none */
	int is_unknown;   /* 1: the loader did not list the libraries: nothing tells that they are the same */
};

/**
 * Look at all of it.
 * @param program  path of the executable
 * @param out      all zero; free with watched_free in any case
 * @return 0, ERR_INPUT (reported: `data` names nothing, or a file cannot be read) or ERR_SYSTEM (reported)
 */
int watched_collect(const struct ci_program *p, const char *program, struct watched *out);
void watched_free(struct watched *w);

/**
 * Compare with what was kept of the last recording.
 * @param why, size  receive what changed first, "model.obj has changed and 2 more"
 * @return 1: something changed, or nothing is kept; 0: all is the same
 */
int watched_changed(const struct watched *w, const char *kept, char *why, size_t size);

/** Keep it. @return 0 or ERR_SYSTEM (reported) */
int watched_keep(const struct watched *w, const char *kept);
