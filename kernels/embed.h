/*
 * The kernels' text inside the command: kernels/embed.py writes build/gen/kernels.c.
 */
#pragma once

#include <stddef.h>

/* One .cl file with all its includes expanded: one OpenCL program. */
struct kernel_file {
	const char *name; /* path in the source tree */
	const char *text;
	int gathers; /* 1: it includes other .cl files, and so also has their kernels */
};
extern const struct kernel_file kernel_files[];
extern const size_t n_kernel_files;

/* A file that defines a kernel: the .cl file itself, or one that includes it. */
struct kernel_place {
	const char *kernel;
	size_t file; /* index in kernel_files */
};
extern const struct kernel_place kernel_places[];
extern const size_t n_kernel_places;
