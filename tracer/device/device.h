/*
 * A device runs kernels and holds buffers. It is an OpenCL device, or "reference": the scalar C twins of kernels/ref in
 * this process. The tracer uses only this header and does not know which one it has. launch.h launches kernels.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "kernels/kernels.h"

/* X(NAME, word): families of traversal kernels. All find the same hits; which one is fastest depends on the type of
 * device. */
#define DEVICE_FAMILIES(X) \
	X(PACKETS, packets)       /* many rays per work item in vectors, eight-wide nodes in rows: CPUs */ \
	X(BINARY, binary)         /* one ray per work item, binary trees */ \
	X(COMPRESSED, compressed) /* one ray per work item, eight-wide nodes of 80 bytes: GPUs */

enum device_family {
#define DEVICE_FAMILY_ENUM(name, word) FAMILY_##name,
	DEVICE_FAMILIES(DEVICE_FAMILY_ENUM)
	N_DEVICE_FAMILIES
};

/* One kernel argument. */
struct device_arg {
	const struct device_buffer *buffer; /* NULL: the argument is a value */
	const void *value;                  /* `bytes` bytes, copied at the launch */
	size_t bytes;
};
#define DEVICE_MAX_ARGS 56

struct device;
struct device_buffer; /* memory on one device */

enum device_type { DEVICE_CPU, DEVICE_GPU, DEVICE_ACCELERATOR, N_DEVICE_TYPES };

/* An OpenCL device as listed by `relume devices`. */
struct device_description {
	unsigned number; /* its index in the list, as accepted by device_open */
	char name[128], platform[64], driver[64], version[128]; /* version: of OpenCL, with the driver's additions */
	enum device_type type;
	unsigned units;
	unsigned width; /* floats that a unit processes at once: vector lanes, or work items in lockstep; 0: unknown */
	uint64_t memory_bytes, buffer_bytes; /* buffer_bytes: the most in one buffer */
};

const char *device_type_name(enum device_type type); /* "cpu", "gpu", "accelerator" */

/** The default family of traversal kernels for devices of a type. */
enum device_family device_type_family(enum device_type type);

/**
 * List the OpenCL devices.
 * @param out  receives an array; free with free()
 * @return 0 or ERR_SYSTEM (reported; if there is no device, with the package to install)
 */
int device_list(struct device_description **out, size_t *n);

/**
 * Find the device in a list that a choice names.
 * @param choice  as for device_open, without "reference"
 * @return 0 or ERR_USAGE (reported)
 */
int device_find(const struct device_description *list, size_t n, const char *choice, size_t *number);

/**
 * Open a device.
 * @param choice  NULL: the first GPU, else the first device found by OpenCL. "reference": the C twins. Else a number
 *                from `relume devices`, a type ("cpu", "gpu", "accelerator": the first of it), or part of a device's
 *                name.
 * @param threads compute threads if the device is a CPU; 0: all cores
 * @param out     receives the device; close with device_close
 * @return 0; ERR_SYSTEM (reported; if there is no OpenCL device, with the package to install); ERR_USAGE (no such
 *         choice)
 */
int device_open(const char *choice, unsigned threads, struct device **out);
void device_close(struct device **dev);

/**
 * Open several devices.
 * @param choices  choices as above, separated by commas; "all": every OpenCL device
 * @param out, n   receive an array; close with device_close_list
 * @return as device_open
 */
int device_open_list(const char *choices, unsigned threads, struct device ***out, size_t *n);
void device_close_list(struct device ***devices, size_t *n);

/**
 * Open the same device again with a separate queue, for another thread: only one thread may use a device at a time.
 * Buffers belong to the device that made them. The two may be closed in any order.
 * @return 0 or ERR_SYSTEM (reported)
 */
int device_share(struct device *dev, struct device **out);

/**
 * Interrupt the device: until device_resume, launches, device_write and device_read do nothing and return ERR_SYSTEM
 * without a report. Any thread may call this. A running kernel runs to its end. The buffers of the current frame are
 * then undefined: create a new tracer after device_resume.
 */
void device_interrupt(struct device *dev);
void device_resume(struct device *dev);
int device_is_interrupted(const struct device *dev);

/** The device's name and driver version in one line, for people and for EXR attributes. Borrowed. */
const char *device_name(const struct device *dev);

/** Set the number of the next frame, which is named in faults of the driver (fault.h). */
void device_set_frame(struct device *dev, uint64_t frame);

/** Description of the device, as listed; NULL: the reference device. Borrowed. */
const struct device_description *device_describe(const struct device *dev);

/** The device's family of traversal kernels: the default of its type, until device_choose_family. */
enum device_family device_family(const struct device *dev);

/** Set the family of traversal kernels. Call before the device's first tracer is created. */
void device_choose_family(struct device *dev, enum device_family family);

extern const char *const device_family_names[N_DEVICE_FAMILIES + 1]; /* followed by NULL */

/**
 * Keep compiled kernels in a folder, for other runs; processes may share it. Call before the device's first kernel
 * runs. PoCL has its own cache, which is used instead unless `always`. Does nothing on the reference device.
 * @param folder  copied
 */
void device_keep_programs(struct device *dev, const char *folder, int always);

/** Print one line to standard error if compiling takes long, even if that is not a terminal. On a terminal the line is
 * always printed. */
void device_tell_compiling(struct device *dev);

/**
 * Start to build the program with most of the kernels of frames, if there is one, on a separate thread: PoCL takes 0.1
 * s to load a compiled program. Call after device_choose_family, device_keep_programs and device_take_hook. Later calls
 * have no effect.
 */
void device_build_early(struct device *dev);

/**
 * Keep compiled programs until the process ends, even when the device is closed: PoCL takes 20 ms to free a program.
 * Call once, and only if no other device is opened afterwards.
 */
void device_leave_programs(struct device *dev);

struct hook;

/** 1 if device_open would open the reference device. choice: as in device_open; may be NULL */
int device_is_reference(const char *choice);

/**
 * Use a hook in the kernels that call it. Call before the device's first kernel runs.
 * @param hook  kept until the device and all shared from it are closed; already compiled for the reference device
 *              (tracer/hook/host.h); NULL: none
 * @return 0 or ERR_USAGE (reported: the reference device cannot compile hooks)
 */
int device_take_hook(struct device *dev, const struct hook *hook);

/** Number of programs loaded from the folder, for this device and all shared from it. */
unsigned device_programs_found(const struct device *dev);

/**
 * Report an ERR_MEMORY. The functions below return ERR_MEMORY, without a report, if the device has too little memory
 * for the request; a smaller one may succeed. A launch may then be partly done. A caller that cannot ask for less
 * reports the error here.
 * @return ERR_SYSTEM (reported with the request and the device's memory)
 */
int device_report_lack(struct device *dev);

/**
 * Make a buffer hold at least `bytes` bytes. Its contents are lost if it grows. If *buffer is NULL, a new buffer is
 * created. 0 bytes count as 16. Drivers allocate more memory than exists and fail when it is used, so a device counts
 * the buffers of all devices shared from it.
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int device_reserve(struct device *dev, struct device_buffer **buffer, size_t bytes);
void device_release(struct device *dev, struct device_buffer **buffer);

/**
 * Copy into or out of a buffer, after all earlier kernels. On return, the caller may change the data written, and data
 * read is complete.
 * @return 0, ERR_MEMORY (device_write only) or ERR_SYSTEM (reported)
 */
int device_write(struct device *dev, struct device_buffer *buffer, size_t offset, const void *data, size_t bytes);
int device_read(struct device *dev, const struct device_buffer *buffer, size_t offset, void *data, size_t bytes);

/**
 * Map the first bytes of a buffer for reading, after all earlier kernels; on a CPU without a copy. No kernel may write
 * to the buffer until device_unmap.
 * @param wait  0: the data may be incomplete until a later call that waits
 * @return 0 or ERR_SYSTEM (reported; nothing is mapped)
 */
int device_map(struct device *dev, const struct device_buffer *buffer, size_t bytes, int wait, const void **out);
int device_unmap(struct device *dev, const struct device_buffer *buffer, const void *mapped);

/** Make a buffer hold at least `bytes` bytes and write them to its start. */
int device_upload(struct device *dev, struct device_buffer **buffer, const void *data, size_t bytes);

/** Run a kernel. Used only by launch.c, which knows the arguments of kernels. @param n_args at most DEVICE_MAX_ARGS
 * @return as launch_NAME */
int device_run(struct device *dev, enum kernel kernel, size_t n_items, const struct device_arg *args, size_t n_args);

/** Wait until everything queued is done. @return 0 or ERR_SYSTEM (reported) */
int device_finish(struct device *dev);

/* Time spent in a kernel, or in copies. */
struct device_spent {
	double wall_s, cpu_s; /* cpu_s: of all threads of this process; meaningless unless the device is a CPU */
	uint64_t count, amount; /* launches and work items, or copies and bytes */
};

struct device_profile {
	struct device_spent kernels[N_KERNELS], writes, reads;
};

/**
 * Record all kernels and copies from now on in a profile. Each kernel is waited for, so everything takes longer.
 * @param profile  kept and written until the next call; NULL: stop recording
 */
void device_set_profile(struct device *dev, struct device_profile *profile);
const char *device_kernel_name(enum kernel kernel);
