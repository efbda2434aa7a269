/*
 * OpenCL 1.2 behind tracer/device/device.h: cl.c, cl_list.c and cl_program.c make all clXxx calls of the project. For
 * device.c alone.
 */
#pragma once

#include <stddef.h>

#include "tracer/device/device.h"

struct cl_device;
struct cl_buffer;
struct fault_place;

/** Every OpenCL device. @param out  receives an array, free with free() @return 0, or ERR_SYSTEM (reported) */
int cl_list(struct device_description **out, size_t *n);

/**
 * Open a device by its number in cl_list.
 * @param threads compute threads where it is a CPU (a sub-device of so many units), 0: all
 * @param place   where this device is at work (fault.h); kept until cl_close; or NULL
 * @return 0 or ERR_SYSTEM (reported)
 */
int cl_open(size_t number, unsigned threads, struct fault_place *place, struct cl_device **out);
void cl_close(struct cl_device **dev);

/** The same device with a queue of its own, for another thread; programs are compiled once for all. As cl_open. */
int cl_share(struct cl_device *dev, struct fault_place *place, struct cl_device **out);

/** The kernels that will run most: it decides which of them are compiled together. */
void cl_choose_family(struct cl_device *dev, enum device_family family);

/** As device_build_early. @param place  taken over: where the builder is at work */
void cl_build_early(struct cl_device *dev, struct fault_place *place);

/* As their namesakes in device.h. */
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

/** One argument of cl_run: a buffer, or a value where it is NULL. */
struct cl_arg {
	const struct cl_buffer *buffer;
	const void *value;
	size_t bytes;
};

/** Queue a kernel; its program is compiled at its first use. @return 0, ERR_MEMORY or ERR_SYSTEM (reported) */
int cl_run(struct cl_device *dev, enum kernel kernel, size_t n_items, const struct cl_arg *args, size_t n_args);
