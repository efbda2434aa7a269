/* Enumeration of OpenCL devices. Used only by cl.c; cl_list() is in cl.h. */
#pragma once

#include <CL/cl.h>
#include <stddef.h>
#include <stdint.h>

#include "tracer/device/device.h"

#define CL_LIST_MOST 64

/** List every device of every platform, in the drivers' order. @return 0 or ERR_SYSTEM (reported: no device found) */
int cl_list_find(cl_device_id ids[CL_LIST_MOST], size_t *n);

/** CL_DEVICE_GLOBAL_MEM_SIZE or a similar property of a device, in bytes; 0: unknown. */
uint64_t cl_list_bytes(cl_device_id id, cl_device_info what);

/** The type of a device; DEVICE_ACCELERATOR if it is neither a CPU nor a GPU. */
enum device_type cl_list_type(cl_device_id id);
