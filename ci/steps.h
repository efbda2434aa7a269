/*
 * One program on its way through `relume ci`: recorded, rendered, compared. Each step is a verb in a process of its
 * own: verbs that read recordings give up their rights for good.
 *
 * KEPT/NAME holds
 *
 *     NAME.trace, NAME.ref   the recording
 *     inputs                 what it depends on (watched.h); there once the recording is whole
 *     frames/                NAME.0000.exr, ...: the frames of this recording and no others
 *     report/, junit.xml, scores.json, summary.md   of this run; a step that fails leaves its error in junit.xml and
 *                            summary.md
 */
#pragma once

#include "ci/plan.h"

struct ci_run {
	const char *relume;   /* this command */
	const char *kept, *baseline; /* folders, without the program's name */
	int when_changed;     /* 1: record only where something watched has changed */
	int own_displays;     /* 1: record each on an Xvfb of its own */
	int display_lock;     /* a file, held while a program is on the display: others would cover its window; -1: none */
};

/** @return the exit code: 0, or that of `relume diff`, or of the step that failed (a message says why) */
int ci_run_program(const struct ci_run *run, const struct ci_program *program);
