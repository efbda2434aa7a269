/*
 * Programs of an OpenCL device: built from the text inside the command, or found where an earlier run left them
 * compiled. For cl.c alone.
 */
#pragma once

#include <CL/cl.h>
#include <limits.h>
#include <stddef.h>

#include "tracer/device/device.h"

struct fault_place;

/* Where programs are kept. All zero: nowhere. */
struct cl_keeping {
	char folder[PATH_MAX - 96]; /* "": nowhere */
	unsigned found;             /* programs that came from there */
	int tells;                  /* 1: one line says so where compiling takes long, outside a terminal, too; 2: it has */
};

int cl_program_is_pocl(cl_device_id device);

/**
 * Keep programs from now on. PoCL does that itself, and is left to it unless `always`.
 * @param folder  copied; made when the first program is kept; ignored when its name is too long
 */
void cl_program_keep(cl_device_id device, const char *folder, int always, struct cl_keeping *keeping);

/** The file whose program nearly all kernels of a family come from; n_kernel_files where there is none. */
size_t cl_program_gathered(cl_device_id device, const struct cl_keeping *keeping, enum device_family family);

/**
 * The file whose program a kernel should come from. PoCL wants few programs: it preprocesses each in every run, for 40
 * ms, unless it is kept here. Others compile all kernels of a program at once, and want only those that a run needs.
 * @param family  the kernels that run beside it
 * @return its number in kernel_files, n_kernel_files: there is no such kernel
 */
size_t cl_program_of(cl_device_id device, const struct cl_keeping *keeping, enum device_family family,
                     const char *kernel);

/**
 * Make the program of one file of kernels.
 * @param file     in kernel_files (kernels/embed.h)
 * @param hook     kernels that call hooks need its text; NULL: there is none
 * @param keeping  where it may lie, and is left; where it cannot be written one warning says so, and no more is kept
 * @param place    where this thread is at work (fault.h), or NULL. A refusal may end the process (fault_refuse)
 * @param said     as for cl_report
 * @param out      to be released by the caller
 * @return 0, ERR_INPUT where it is the hook that does not compile, or ERR_SYSTEM (reported, after the compiler's own
 * words)
 */
int cl_program_make(cl_context context, cl_device_id device, size_t file, const struct hook *hook,
                    struct cl_keeping *keeping, struct fault_place *place, int *said, cl_program *out);
