/*
 * Programs of an OpenCL device: built from the source embedded in the command, or loaded from the binaries that an
 * earlier run kept. Used only by cl.c.
 */
#pragma once

#include <CL/cl.h>
#include <limits.h>
#include <stddef.h>

#include "tracer/device/device.h"

struct fault_place;

/* Storage of compiled programs. All zero: programs are not kept. */
struct cl_keeping {
	char folder[PATH_MAX - 96]; /* "": programs are not kept */
	unsigned found;             /* programs loaded from the folder */
	int tells;                  /* 1: print a line if compiling takes long, even without a terminal; 2: printed */
};

int cl_program_is_pocl(cl_device_id device);

/**
 * Keep programs from now on. PoCL has its own cache, which is used instead unless `always`.
 * @param folder  copied; created when the first program is kept; ignored if its name is too long
 */
void cl_program_keep(cl_device_id device, const char *folder, int always, struct cl_keeping *keeping);

/** Number of the file whose program has nearly all kernels of a family; n_kernel_files: no such file. */
size_t cl_program_gathered(cl_device_id device, const struct cl_keeping *keeping, enum device_family family);

/**
 * Choose the file whose program a kernel should come from. Few programs suit PoCL: unless they are kept here, it
 * preprocesses each in every run, which takes 40 ms. Other drivers compile all kernels of a program at once, so
 * programs with only the kernels that a run needs suit them.
 * @param family  family of the kernels that run together with it
 * @return its number in kernel_files; n_kernel_files: no such kernel
 */
size_t cl_program_of(cl_device_id device, const struct cl_keeping *keeping, enum device_family family,
                     const char *kernel);

/**
 * Load or build the program of one file of kernels.
 * @param file     its number in kernel_files (kernels/embed.h)
 * @param hook     user's hook, whose source is needed by kernels that call hooks; NULL: no hook
 * @param keeping  where the program is looked up and kept. If the folder cannot be written, one warning is printed and
 *                 nothing more is kept
 * @param place    records when this thread is in the driver (fault.h), or NULL. A refusal may end the process
 *                 (fault_refuse)
 * @param said     as in cl_report
 * @param out      receives the program; release with clReleaseProgram
 * @return 0, ERR_INPUT if the hook does not compile, or ERR_SYSTEM (both reported, after the compiler's own messages)
 */
int cl_program_make(cl_context context, cl_device_id device, size_t file, const struct hook *hook,
                    struct cl_keeping *keeping, struct fault_place *place, int *said, cl_program *out);
