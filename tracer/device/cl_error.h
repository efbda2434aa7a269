/* Names of OpenCL errors. */
#pragma once

#include <CL/cl.h>

/** Name of an error in OpenCL's headers. */
const char *cl_error_name(cl_int code);

/** 1: OpenCL or a known extension defines this error code; 0: the driver returned an invalid one. */
int cl_error_exists(cl_int code);

/**
 * Report the first error of a device. Later errors add nothing: a lost device fails every command.
 * @param said  shared by all threads that use the device; initially 0
 * @return ERR_SYSTEM
 */
int cl_report(int *said, cl_int code, const char *what);
