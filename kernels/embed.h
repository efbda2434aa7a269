/*
 * The kernels' text inside the command: kernels/embed.py writes build/gen/kernels.c.
 */
#pragma once

#include <stddef.h>

/* One .cl file with everything it includes in place: one OpenCL program. */
struct kernel_file {
	const char *name; /* path in the source tree */
	const char *text;
	int gathers; /* 1: it consists of other .cl files, whose kernels it has too */
};
extern const struct kernel_file kernel_files[];
extern const size_t n_kernel_files;

/* Where a kernel is defined: in one file, and in those that gather it. */
struct kernel_place {
	const char *kernel;
	size_t file; /* in kernel_files */
};
extern const struct kernel_place kernel_places[];
extern const size_t n_kernel_places;
