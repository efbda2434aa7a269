/*
 * Files that appear only when complete: written beside their final place under a temporary name, then renamed.
 *
 * The temporary name is "FINAL.HOST-PID-N.part". Writers on several machines never collide, and leftovers of a killed
 * process can be distinguished from a file being written.
 */
#pragma once

#include <limits.h>
#include <stddef.h>
#include <stdio.h>

/* A stream to such a file. */
struct part_file {
	FILE *stream;
	const char *path; /* its final name; borrowed */
	char part[PATH_MAX + 128];
};

/** @param path  kept until part_close. @return 0 or ERR_SYSTEM (reported) */
int part_open(struct part_file *file, const char *path);

/**
 * Close the file and give it its final name; if `err` reports an earlier failure, remove it instead.
 * @return err, or ERR_SYSTEM (reported)
 */
int part_close(struct part_file *file, int err);

/**
 * Name an unfinished file.
 * @param part, size  receive the name
 * @return 0 or ERR_SYSTEM (reported: the name is too long)
 */
int part_begin(const char *path, char *part, size_t size);

/** Give a complete file its final name. @return 0, or ERR_SYSTEM (reported; the file is removed) */
int part_finish(const char *part, const char *path);

/** Remove an unfinished file. */
void part_drop(const char *part);

/** Remove all unfinished files of this process, which is about to end. No part_* call may run then or later. */
void part_drop_all(void);

/** Remove the files that an ended process of this machine left in a file's folder. */
void part_sweep_of(const char *path, long process);

/**
 * Remove the files that killed processes of this machine left in a file's folder: those of no running process,
 * untouched for a minute (the process may run in another container, where it cannot be seen).
 */
void part_sweep(const char *path);
