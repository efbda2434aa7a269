/* OpenCL's errors by OpenCL's own names for them. */
#pragma once

#include <CL/cl.h>

/** An error's name in OpenCL's headers. */
const char *cl_error_name(cl_int code);

/** 1: OpenCL has an error of this code that it may return here; 0: the driver returns rubbish. */
int cl_error_exists(cl_int code);

/**
 * Report a device's first error. Those that follow say nothing new: a device that is gone refuses all that its queues
 * are asked for.
 * @param said  of the device and all threads that use it, initially 0
 * @return ERR_SYSTEM
 */
int cl_report(int *said, cl_int code, const char *what);
