/*
 * Launches of kernels. On a GPU that also draws a screen the driver kills what runs longer than a second or two, so
 * that a launch of many work items becomes several of about a tenth of a second. PoCL counts wrong where launches of
 * several widths run at once. For cl.c alone.
 */
#pragma once

#include <CL/cl.h>
#include <stddef.h>

/* How fast a kernel runs on a queue that measures (CL_QUEUE_PROFILING_ENABLE). All zero: not known yet. */
struct cl_pace {
	size_t most_items;  /* of a launch */
	cl_event measured;  /* a launch under way, or NULL */
	size_t n_measured;  /* its work items */
};

void cl_pace_free(struct cl_pace *pace);

/**
 * Queue a kernel whose arguments are set.
 * @param group  work items of a work group
 * @param pace   of this kernel on this queue; NULL: one launch, however long it runs
 * @return CL_SUCCESS, or OpenCL's error of the part that cannot be queued
 */
cl_int cl_launch(cl_command_queue queue, cl_kernel kernel, size_t n_items, size_t group, struct cl_pace *pace);

/**
 * The same for PoCL (3.1, 5.0). It loads a kernel for the widest launch so far, and again for a wider one; a launch
 * that ends gives back whichever has its group size and was used last. Where two run at once that may be the other
 * one's, whose count goes below 0: PoCL then ends the process. So the first launch of a kernel on a queue, which later
 * ones wait for, is as wide as any of its group size may be, with work items that do nothing, and wider ones have
 * groups of their own.
 * @param group    of the narrowest launches
 * @param widened  of this kernel on this queue: what was launched; all zero at first
 */
cl_int cl_launch_wide(cl_command_queue queue, cl_kernel kernel, size_t n_items, size_t group, unsigned char *widened);
