/*
 * The OpenCL 1.2 implementation of tracer/device/device.h. All clXxx calls of the project are in cl.c, cl_list.c,
 * cl_program.c and cl_launch.c. Used only by device.c.
 */
#pragma once

#include <stddef.h>

#include "tracer/device/device.h"

struct cl_device;
struct cl_buffer;
struct fault_place;

/** List every OpenCL device. @param out receives an array; free with free() @return 0 or ERR_SYSTEM (reported) */
int cl_list(struct device_description **out, size_t *n);

/**
 * Open a device by its number in cl_list.
 * @param threads compute threads if the device is a CPU (a sub-device with this many units); 0: all
 * @param place   records when this device is in the driver (fault.h); kept until cl_close; or NULL
 * @return 0 or ERR_SYSTEM (reported)
 */
int cl_open(size_t number, unsigned threads, struct fault_place *place, struct cl_device **out);
void cl_close(struct cl_device **dev);

/** Open the same device with a separate queue, for another thread. Programs are compiled once and shared. @return as
 * cl_open */
int cl_share(struct cl_device *dev, struct fault_place *place, struct cl_device **out);

/** Set the family of kernels that will run most. It decides which kernels are compiled together. */
void cl_choose_family(struct cl_device *dev, enum device_family family);

/** As device_build_early. @param place owned by the builder thread from now on; records when it is in the driver */
void cl_build_early(struct cl_device *dev, struct fault_place *place);

/* Same as the device_ functions of these names in device.h. */
void cl_take_hook(struct cl_device *dev, const struct hook *hook);
void cl_keep_programs(struct cl_device *dev, const char *folder, int always);
void cl_tell_compiling(struct cl_device *dev);
void cl_leave_programs(struct cl_device *dev);
unsigned cl_programs_found(struct cl_device *dev);
int cl_report_lack(struct cl_device *dev);
int cl_reserve(struct cl_device *dev, struct cl_buffer **buffer, size_t bytes);
void cl_release(struct cl_device *dev, struct cl_buffer **buffer);
int cl_write(struct cl_device *dev, struct cl_buffer *buffer, size_t offset, const void *data, size_t bytes);
int cl_read(struct cl_device *dev, const struct cl_buffer *buffer, size_t offset, void *data, size_t bytes);
int cl_map(struct cl_device *dev, const struct cl_buffer *buffer, size_t bytes, int wait, const void **out);
int cl_unmap(struct cl_device *dev, const struct cl_buffer *buffer, const void *mapped);
int cl_finish(struct cl_device *dev);

/** One argument of cl_run: a buffer, or a value if buffer is NULL. */
struct cl_arg {
	const struct cl_buffer *buffer;
	const void *value;
	size_t bytes;
};

/** Queue a kernel; its program is compiled on first use. @return 0, ERR_MEMORY or ERR_SYSTEM (reported) */
int cl_run(struct cl_device *dev, enum kernel kernel, size_t n_items, const struct cl_arg *args, size_t n_args);
