/*
 * A device: where kernels run and buffers live. It is an OpenCL device, or "reference": the scalar C twins of
 * kernels/ref, in this process. The tracer is written once against this header and does not know which one it has.
 * launch.h launches kernels.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "kernels/kernels.h"

/* X(NAME, word): families of traversal kernels. Kinds of device differ in which runs fast; all find the same. */
#define DEVICE_FAMILIES(X) \
	X(PACKETS, packets)       /* many rays a work item in vectors, eight-wide nodes in rows: CPUs */ \
	X(BINARY, binary)         /* one ray a work item, binary trees */ \
	X(COMPRESSED, compressed) /* one ray a work item, eight-wide nodes of 80 bytes: GPUs */

enum device_family {
#define DEVICE_FAMILY_ENUM(name, word) FAMILY_##name,
	DEVICE_FAMILIES(DEVICE_FAMILY_ENUM)
	N_DEVICE_FAMILIES
};

/* One kernel argument. */
struct device_arg {
	const struct device_buffer *buffer; /* NULL: a value */
	const void *value;                  /* of `bytes` bytes, copied at the launch */
	size_t bytes;
};
#define DEVICE_MAX_ARGS 56

struct device;
struct device_buffer; /* memory on one device */

enum device_type { DEVICE_CPU, DEVICE_GPU, DEVICE_ACCELERATOR, N_DEVICE_TYPES };

/* An OpenCL device as `relume devices` lists it; its place in the list is the number device_open takes. */
struct device_description {
	unsigned number; /* its place in the list */
	char name[128], platform[64], driver[64], version[128]; /* version: of OpenCL, and what the driver says beside it */
	enum device_type type;
	unsigned units;
	unsigned width; /* floats that a unit computes with at once: of a vector, or work items in step; 0: it does not say */
	uint64_t memory_bytes, buffer_bytes; /* buffer_bytes: of one buffer, at most */
};

const char *device_type_name(enum device_type type); /* "cpu", "gpu", "accelerator" */

/** The family of traversal kernels that devices of a type run unless they are told otherwise. */
enum device_family device_type_family(enum device_type type);

/**
 * List the OpenCL devices.
 * @param out  receives an array; free it with free()
 * @return 0, or ERR_SYSTEM (reported: no device at all names the package to install)
 */
int device_list(struct device_description **out, size_t *n);

/**
 * The device of a list that a choice names.
 * @param choice  as for device_open, without "reference"
 * @return 0 or ERR_USAGE (reported)
 */
int device_find(const struct device_description *list, size_t n, const char *choice, size_t *number);

/**
 * Open a device.
 * @param choice  NULL: the first GPU, else the first device found by OpenCL. "reference": the C twins. Else a number
 *                from `relume devices`, a type ("cpu", "gpu", "accelerator": the first of it), or part of a device's
 *                name.
 * @param threads compute threads where the device is a CPU, 0: all cores
 * @param out     owned by the caller, device_close
 * @return 0; ERR_SYSTEM (reported: no OpenCL device at all names the package to install); ERR_USAGE (no such choice)
 */
int device_open(const char *choice, unsigned threads, struct device **out);
void device_close(struct device **dev);

/**
 * Open several devices.
 * @param choices  as `choice` above, several with commas; "all": every OpenCL device
 * @param out, n   receive an array; device_close_list
 * @return as device_open
 */
int device_open_list(const char *choices, unsigned threads, struct device ***out, size_t *n);
void device_close_list(struct device ***devices, size_t *n);

/**
 * The same device once more, with a queue of its own: a device is used by one thread at a time. Buffers belong to the
 * one that made them. The two may be closed in any order.
 * @return 0 or ERR_SYSTEM (reported)
 */
int device_share(struct device *dev, struct device **out);

/**
 * Break off: from now on launches, device_write and device_read do nothing and return ERR_SYSTEM without a report. Any
 * thread may call this. A kernel that is running runs to its end. Buffers of the frame under way are in no certain
 * state: make a new tracer after device_resume.
 */
void device_interrupt(struct device *dev);
void device_resume(struct device *dev);
int device_is_interrupted(const struct device *dev);

/** The device's name and driver version in one line, for people and for EXR attributes. Borrowed. */
const char *device_name(const struct device *dev);

/** The frame that is drawn next: a fault of the driver names it (fault.h). */
void device_set_frame(struct device *dev, uint64_t frame);

/** The device as it is listed; NULL: the reference device. Borrowed. */
const struct device_description *device_describe(const struct device *dev);

/** The family of traversal kernels that it runs: by its kind, until device_choose_family. */
enum device_family device_family(const struct device *dev);

/** Take one of the families whatever the device is; before its first tracer. */
void device_choose_family(struct device *dev, enum device_family family);

extern const char *const device_family_names[N_DEVICE_FAMILIES + 1]; /* ended by NULL */

/**
 * Keep compiled kernels in a folder, for other runs; processes may share it. Call it before the device's first kernel
 * runs. PoCL keeps them itself, and is left to it unless `always`. Does nothing on the reference device.
 * @param folder  copied
 */
void device_keep_programs(struct device *dev, const char *folder, int always);

/** From now on, one line on standard error says so where compiling takes long, be that a terminal or not. On a terminal
 * it always does. */
void device_tell_compiling(struct device *dev);

/**
 * Build the program that most frames' kernels come from, where there is one, on a thread of its own: PoCL takes 0.1 s
 * to load what it compiled before. Call it after device_choose_family, device_keep_programs and device_take_hook; only
 * the first call counts.
 */
void device_build_early(struct device *dev);

/**
 * Leave what was compiled to the process's end, also when the device is closed: PoCL takes 20 ms to take a program
 * apart. Call it once, where no other device is opened afterwards.
 */
void device_leave_programs(struct device *dev);

struct hook;

/** 1 where device_open would open the reference device. choice: or NULL */
int device_is_reference(const char *choice);

/**
 * Take a hook's text into the kernels that call it; before the device's first kernel runs.
 * @param hook  kept until device_close of it and all shared from it; the reference device's is compiled
 * (tracer/hook/host.h); NULL: none
 * @return 0 or ERR_USAGE (reported: the reference device compiles none)
 */
int device_take_hook(struct device *dev, const struct hook *hook);

/** How many programs came from there, for this device and all that were shared from it. */
unsigned device_programs_found(const struct device *dev);

/**
 * ERR_MEMORY, in what follows: the device has too little memory for what was asked for; less at once may do. It is not
 * reported. A launch may be done in part. Whoever cannot ask for less reports it here.
 * @return ERR_SYSTEM (reported: what was asked for, and what the device has)
 */
int device_report_lack(struct device *dev);

/**
 * Make a buffer at least so large; contents are lost where it grows. *buffer NULL: a new one. 0 bytes count as 16.
 * Drivers hand out memory that is not there and fail when it is used. So this device counts all buffers of its own and
 * of those shared from it.
 * @return 0, ERR_MEMORY or ERR_SYSTEM (reported)
 */
int device_reserve(struct device *dev, struct device_buffer **buffer, size_t bytes);
void device_release(struct device *dev, struct device_buffer **buffer);

/**
 * Copy into or out of a buffer, after all earlier kernels. What is written may be changed at once; what is read is
 * there.
 * @return 0, ERR_MEMORY (of device_write) or ERR_SYSTEM (reported)
 */
int device_write(struct device *dev, struct device_buffer *buffer, size_t offset, const void *data, size_t bytes);
int device_read(struct device *dev, const struct device_buffer *buffer, size_t offset, void *data, size_t bytes);

/**
 * Look at the first bytes of a buffer, all earlier kernels done; on a CPU without a copy. No kernel may write to it
 * until device_unmap.
 * @param wait  0: it may not be there before a later call that waits
 * @return 0 or ERR_SYSTEM (reported; nothing is mapped)
 */
int device_map(struct device *dev, const struct device_buffer *buffer, size_t bytes, int wait, const void **out);
int device_unmap(struct device *dev, const struct device_buffer *buffer, const void *mapped);

/** Reserve for so many bytes and write them to the buffer's start. */
int device_upload(struct device *dev, struct device_buffer **buffer, const void *data, size_t bytes);

/** For launch.c alone, which knows kernels' arguments. As its functions. @param n_args  DEVICE_MAX_ARGS at most */
int device_run(struct device *dev, enum kernel kernel, size_t n_items, const struct device_arg *args, size_t n_args);

/** Wait until everything queued is done. @return 0 or ERR_SYSTEM (reported) */
int device_finish(struct device *dev);

/* What a device did, kernel by kernel, and what copying took. */
struct device_spent {
	double wall_s, cpu_s; /* cpu_s: of all threads of this process; says nothing where the device is no CPU */
	uint64_t count, amount; /* launches and work items, or copies and bytes */
};

struct device_profile {
	struct device_spent kernels[N_KERNELS], writes, reads;
};

/**
 * Count all that is done from now on in a profile. Each kernel is waited for, so everything takes longer.
 * @param profile  kept and written until the next call; NULL: no longer
 */
void device_set_profile(struct device *dev, struct device_profile *profile);
const char *device_kernel_name(enum kernel kernel);
