/*
 * The steps of one program in `relume ci`: record, render, compare. Each step is a command in a process of its own,
 * because commands that read recordings drop their rights for good.
 *
 * KEPT/NAME holds
 *
 *     NAME.trace, NAME.ref   the recording
 *     inputs                 what the recording depends on (watched.h); exists only once the recording is complete
 *     frames/                NAME.0000.exr, ...: the frames of this recording and no others
 *     report/, junit.xml, scores.json, summary.md   of this run; a failed step leaves its error in junit.xml and
 *                            summary.md
 */
#pragma once

#include "ci/plan.h"

struct ci_run {
	const char *relume;   /* path of this executable */
	const char *kept, *baseline; /* folders, without the program's name */
	int when_changed;     /* 1: record only if a watched input has changed */
	int own_displays;     /* 1: record on an Xvfb of the program's own */
	int display_lock;     /* locked while a program uses the display: windows must not cover each other; -1: none */
};

/** @return the exit code: 0, that of `relume diff`, or that of the step that failed (reported) */
int ci_run_program(const struct ci_run *run, const struct ci_program *program);
