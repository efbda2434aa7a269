/*
 * Launches of kernels. On a GPU that also draws a screen the driver kills what runs longer than a second or two, so that a launch of
 * many work items becomes several of about a tenth of a second. For cl.c alone.
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
