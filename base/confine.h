/*
 * A recording may come from a stranger. A verb that reads one gives up, before it reads, what it does not need: all files but those that its
 * command line names, sockets, other programs. A fault in a reader then leaves whoever wrote the recording with nothing to reach.
 *
 * Files: Landlock (Linux 5.13; truncation from 6.2 on). It binds this thread and all threads and processes that it starts from here on, so
 * it comes before the first of them. Calls: seccomp, through libseccomp. A kernel that lacks one of them is named in a warning, and the verb
 * goes on.
 */
#pragma once

#include <stddef.h>

enum confine_kind {
	CONFINE_NOT,
	CONFINE_READER, /* starts no program; limits_of_reader (limits.h) */
	CONFINE_SCORER, /* starts no program; reads as many pictures as there are, without limits */
	CONFINE_TRACER  /* opens OpenCL devices: their libraries and caches, and the linker that PoCL starts; limits_of_tracer */
};

enum confine_use {
	CONFINE_UNUSED,
	CONFINE_READS,    /* a file, a folder with all in it, or a pattern: its folder */
	CONFINE_WRITES,   /* a file: its folder */
	CONFINE_MAKES,    /* a file or a pattern: its folder, made where it is missing */
	CONFINE_FILLS,    /* a folder, made where it is missing */
	CONFINE_DRY,      /* no file: what would be made is not */
	CONFINE_RECORDING /* as CONFINE_READS; of a file also its references and its index. Where that is to be made: its folder */
};

struct confine_file {
	const char *path;
	enum confine_use use;
};

/**
 * Give up all else. System libraries and their settings can still be read. "-" and what does not exist are passed over.
 * A folder that was made for it, and is left empty, goes again at exit.
 * @return 0, or ERR_SYSTEM (reported) where something that is there cannot be kept for lack of descriptors or memory
 */
int confine_to(const struct confine_file *files, size_t n, enum confine_kind kind);
