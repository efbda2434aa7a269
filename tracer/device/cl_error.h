/* OpenCL's errors by OpenCL's own names for them. */
#pragma once

#include <CL/cl.h>

/** Report an error. @return ERR_SYSTEM */
int cl_report(cl_int code, const char *what);
