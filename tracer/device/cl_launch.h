/*
 * Launches of kernels. On a GPU that also drives a screen, the driver kills kernels that run longer than a second or
 * two, so a launch of many work items is divided into several of about a tenth of a second. PoCL miscounts references
 * if launches of different widths run at the same time. Used only by cl.c.
 */
#pragma once

#include <CL/cl.h>
#include <stddef.h>

/* Speed of a kernel on a queue that measures (CL_QUEUE_PROFILING_ENABLE). All zero: not known yet. */
struct cl_pace {
	size_t most_items;  /* most work items in a launch */
	cl_event measured;  /* a launch in progress, or NULL */
	size_t n_measured;  /* its work items */
};

void cl_pace_free(struct cl_pace *pace);

/**
 * Queue a kernel whose arguments have been set.
 * @param group  work items in a work group
 * @param pace   speed of this kernel on this queue; NULL: a single launch, however long it runs
 * @return CL_SUCCESS, or the OpenCL error of the part that could not be queued
 */
cl_int cl_launch(cl_command_queue queue, cl_kernel kernel, size_t n_items, size_t group, struct cl_pace *pace);

/**
 * The same for PoCL (3.1, 5.0). PoCL loads a kernel for the widest launch so far, and again for each wider one. A
 * launch that ends releases whichever loaded kernel has its group size and was used last. If two launches run at once,
 * that may be the other launch's kernel, whose reference count then drops below 0, and PoCL ends the process. Therefore
 * the first launch of a kernel on a queue, which later ones wait for, is padded with idle work items to the greatest
 * width for its group size. Wider launches have a larger group size.
 * @param group    work items in a work group of the narrowest launches
 * @param widened  a bit for each width that this kernel has been launched with on this queue; initially 0
 */
cl_int cl_launch_wide(cl_command_queue queue, cl_kernel kernel, size_t n_items, size_t group, unsigned char *widened);
