/* Watches a running program from outside until a recorder reports: which of its processes run without one? */
#pragma once

#include <sys/types.h>

#include "capture/executable.h"

struct watching {
	unsigned seen;          /* SEEN_* of all processes (stats.h) */
	pid_t stranger;         /* a process without a recorder, one with OpenGL or Vulkan before others; 0: there is none */
	unsigned stranger_seen; /* its SEEN_* */
	enum executable_kind kind;
	int stranger_rights; /* 1: it has the rights of its file's owner or group */
	char name[64];
};

/** Look at a process and all that it has started. */
void watching_look(pid_t root, struct watching *watching);
