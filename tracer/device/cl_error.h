/* OpenCL's errors by OpenCL's own names for them. */
#ifndef TRACER_DEVICE_CL_ERROR_H
#define TRACER_DEVICE_CL_ERROR_H

#include <CL/cl.h>

/** Report an error. @return ERR_SYSTEM */
int cl_report(cl_int code, const char *what);

#endif
