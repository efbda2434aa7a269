/*
 * Recordings may be untrusted. Before opening one, a verb drops every right it does not need: files that its command
 * line does not name, sockets, other programs. If a recording then exploits a fault in a reader, it can reach nothing.
 *
 * Files: Landlock (Linux 5.13; truncation from 6.2 on). It binds this thread and the threads and processes started
 * later, so confine before starting any. Calls: seccomp, through libseccomp. If the kernel lacks one of the two, a
 * warning says so and the verb continues.
 */
#pragma once

#include <stddef.h>

enum confine_kind {
	CONFINE_NOT,
	CONFINE_READER, /* starts no program; limits_of_reader (limits.h) */
	CONFINE_SCORER, /* starts no program; reads as many pictures as there are, without limits */
	CONFINE_TRACER  /* opens OpenCL devices: their libraries and caches, and the linker that PoCL starts;
	                   limits_of_tracer */
};

enum confine_use {
	CONFINE_UNUSED,
	CONFINE_READS,    /* a file, a folder with all in it, or a pattern: its folder */
	CONFINE_WRITES,   /* a file: its folder */
	CONFINE_MAKES,    /* a file or a pattern: its folder, made if missing */
	CONFINE_FILLS,    /* a folder, made if missing */
	CONFINE_DRY,      /* nothing: a dry run writes no file */
	CONFINE_RECORDING /* as CONFINE_READS, with a file's references and index; its folder if the index must be built */
};

struct confine_file {
	const char *path;
	enum confine_use use;
};

/**
 * Drop all other rights. System libraries and their settings stay readable. Skips "-" and files that do not exist.
 * A folder made here is removed at exit if it is still empty.
 * @return 0, or ERR_SYSTEM (reported) if an existing file cannot be kept for lack of descriptors or memory
 */
int confine_to(const struct confine_file *files, size_t n, enum confine_kind kind);
