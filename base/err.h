/*
 * Errors and exit codes, the same in every stage outside the traced program.
 *
 * Functions return 0 or a negative ERR_*; results go out by pointer. err_report prints the text once, where the facts
 * are known; callers only pass the code on. The command exits with the negated code.
 */
#pragma once

#include <stdint.h>

enum {
	ERR_FAILED = -1,     /* compared, and the comparison failed */
	ERR_USAGE = -2,      /* wrong usage: options, ranges, names */
	ERR_INPUT = -3,      /* an input is missing, unreadable or not what it should be */
	ERR_BASELINE = -4,   /* a baseline is new or missing */
	ERR_SYSTEM = -5,     /* a device or the system failed: memory, disk, OpenCL, a child process */
	ERR_INCOMPLETE = -6, /* frames are there, but some of what the program drew is missing from them */
	ERR_MEMORY = -7      /* too large for the device's memory at once; not reported, never an exit code
	                        (tracer/device/device.h) */
};

/**
 * Print "relume: WHERE: TEXT" as one line on standard error. A process prints only its first "out of memory".
 *
 * @param code   ERR_*, returned unchanged so that `return err_report(...)` reads well
 * @param where  file, or file and frame or call ("gears.trace: frame 12"); NULL leaves it out
 * @param fmt    printf format: what is wrong, and what to do about it; no newline
 * @return code
 */
int err_report(int code, const char *where, const char *fmt, ...) __attribute__((format(printf, 3, 4)));

/**
 * Print only the first report of a group of threads: a disk that is full for one is full for all. From now on this
 * thread shares `said` (initially 0) with the rest of its group. NULL leaves the group. Warnings are always printed.
 */
void err_share(int *said);

/**
 * Tell the printer whether the last line of standard error is a progress bar (1) or not (0). Lines then replace the
 * bar, which is drawn again.
 */
void err_clear_bar(int stands);

/* Lines printed so far by processes that do the same work in turn. Lives in memory they share; initially all 0. */
struct err_lines {
	struct { uint64_t hash; uint32_t process; } said[1024];
};

/** From now on, skip lines that an earlier one of these processes has printed. @param process  counts from 1 */
void err_carry_on(struct err_lines *lines, uint32_t process);

/** Print "relume: WHERE: warning: TEXT": something the user should know, although work continues. */
void err_warn(const char *where, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
