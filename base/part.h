/*
 * Files that appear whole: written beside their final place under a temporary name, then renamed.
 *
 * The temporary name is "FINAL.HOST-PID-N.part". Writers on several machines never collide, and the leftovers of a killed process
 * can be told from a file being written.
 */
#pragma once

#include <limits.h>
#include <stddef.h>
#include <stdio.h>

/* A stream for a file that appears whole. */
struct part_file {
	FILE *stream;
	const char *path; /* its final name; borrowed */
	char part[PATH_MAX + 128];
};

/** @param path  kept until part_close. @return 0 or ERR_SYSTEM (reported) */
int part_open(struct part_file *file, const char *path);

/**
 * The file is whole: close it and give it its final name. Remove it where `err` says that something has failed before.
 * @return err, or ERR_SYSTEM (reported)
 */
int part_close(struct part_file *file, int err);

/**
 * Name an unfinished file.
 * @param part, size  receive the name
 * @return 0 or ERR_SYSTEM (reported: the name is too long)
 */
int part_begin(const char *path, char *part, size_t size);

/** The file is whole: give it its final name. @return 0, or ERR_SYSTEM (reported; the file is removed) */
int part_finish(const char *part, const char *path);

/** Remove an unfinished file. */
void part_drop(const char *part);

/** Remove all unfinished files of this process, which is about to end. No other part_* call may be running, or run later. */
void part_drop_all(void);

/** Remove what a process of this machine that has ended left in a file's folder. */
void part_sweep_of(const char *path, long process);

/**
 * Remove what killed processes of this machine left in a file's folder: files of no running process, untouched for a minute (the
 * process may run unseen in another container).
 */
void part_sweep(const char *path);
