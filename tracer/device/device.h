/*
 * A device: where kernels run and buffers live. Either an OpenCL device, or "reference": the scalar C twins of
 * kernels/ref, in this process. The tracer is written once against this header and does not know which one it has.
 *
 * Every kernel has an enumerator, one OpenCL function "NAME" and one C twin "NAME_c" that does the work items
 * first .. last-1. Both take the same arguments in the same order; the kernel's own header comment is their
 * specification. Work items beyond the count given must do nothing: OpenCL rounds the global size up to work groups.
 */
#ifndef TRACER_DEVICE_DEVICE_H
#define TRACER_DEVICE_DEVICE_H

#include <stddef.h>
#include <stdint.h>

/* X(name): kernel NAME in kernels/, twin NAME_c in kernels/ref/. */
#define DEVICE_KERNELS(X) \
	X(camera_packet)    /* camera rays, a tile of 32 x 32 pixels a work item, eight-wide trees; nearest fragment or a column of them */ \
	X(camera_wide)      /* the same, one pixel a work item (GPUs) */ \
	X(camera_compressed) /* the same, compressed nodes */ \
	X(occlude_packet)   /* shadow and other short rays, a packet of consecutive ones a work item, 8-wide nodes */ \
	X(occlude_wide)     /* the same, one ray a work item */ \
	X(intersect_packet) /* nearest hit, a packet a work item */ \
	X(intersect_wide)   /* the same, one ray a work item */ \
	X(occlude_binary)   /* one ray a work item, in numbers alone (GPUs): BVH2 */ \
	X(intersect_binary) \
	X(occlude_compressed) /* the same, compressed nodes */ \
	X(intersect_compressed) \
	X(vertex)           /* GL's vertex stage: one vertex of one instance a work item */ \
	X(gather)           /* one pixel a work item: its fragments into one dense list */ \
	X(shade)            /* one fragment a work item: GL's colour of it, and the shadow rays it wants */ \
	X(shade_packet)     /* the same, consecutive fragments a work item (CPUs) */ \
	X(shadow_ray)       /* one fragment a work item: its ray to one light */ \
	X(shadow_ray_packet) /* the same, consecutive ones a work item (CPUs) */ \
	X(hit_ray)          /* one hit of a path a work item: its ray to one light */ \
	X(ao_ray)           /* one fragment a work item: a look around */ \
	X(shadow_sum)       /* one ray to a light a work item: what arrives where nothing stopped it */ \
	X(shadow_start)     /* one stopped ray a work item: into a list, to go on through what lets light pass */ \
	X(shadow_walk)      /* one of these a work item: past what it hit */ \
	X(scan_sum)         /* a chunk of counts a work item: their sum */ \
	X(scan_place)       /* the same: where each count's results go */ \
	X(gather_paths)     /* one path a work item: its next rays into one dense list */ \
	X(leave)            /* one fragment a work item: its mirrored, bent and scattered rays */ \
	X(sky_ray)          /* one path a work item: its look at the sky where it hit nothing */ \
	X(want_lights)      /* one path a work item: lights to be asked for at its hit */ \
	X(shade_hit)        /* one path a work item: the colour it found and its next rays */ \
	X(credit)           /* one path a work item: what it found into its fragment */ \
	X(ao_shade)         /* one fragment a work item: its openness as its colour */ \
	X(clear)            /* one pixel a work item: a Clear */ \
	X(resolve)          /* one pixel a work item: per-fragment operations in draw order */ \
	X(merge_samples)    /* one pixel a work item: its samples into one */ \
	X(add_pass)         /* one pixel a work item: a pass of several to their sum */ \
	X(compose)          /* one pixel a work item: the planes of the finished picture */ \
	X(compose_packet)   /* the same, several pixels a work item (CPUs) */

enum device_kernel {
#define DEVICE_KERNEL_ENUM(name) KERNEL_##name,
	DEVICE_KERNELS(DEVICE_KERNEL_ENUM)
	N_DEVICE_KERNELS
};

/*
 * Families of traversal kernels: what runs fast differs by kind of device. All find the same.
 *   X(NAME, word)
 */
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
#define ARG_BUFFER(b) ((struct device_arg){ .buffer = (b) })
#define ARG_VALUE(v) ((struct device_arg){ .value = &(v), .bytes = sizeof(v) })

/*
 * A C twin: does work items first .. last-1. args[i] points to the buffer's memory, or to the value.
 */
typedef void device_twin(const void *const *args, size_t first, size_t last);

struct device;
struct device_buffer; /* memory on one device */

enum device_type { DEVICE_CPU, DEVICE_GPU, DEVICE_ACCELERATOR, N_DEVICE_TYPES };

/* An OpenCL device as `relume devices` lists it; its place in the list is the number device_open takes. */
struct device_description {
	char name[128], platform[64], driver[64];
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
 * Open a device.
 * @param choice  NULL: the first GPU, else the first device found by OpenCL. "reference": the C twins. Else a number from
 *                `relume devices`, a type ("cpu", "gpu", "accelerator": the first of it), or part of a device's name.
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
 * The same device once more, with a queue of its own: a device is used by one thread at a time. Buffers belong to the one
 * that made them. The two may be closed in any order.
 * @return 0 or ERR_SYSTEM (reported)
 */
int device_share(struct device *dev, struct device **out);

/**
 * Break off: from now on device_run, device_write and device_read do nothing and return ERR_SYSTEM without a report. May be
 * called from any thread; what is running on the device runs to its end. What the frame under way had placed on the device
 * is in no certain state: make a new tracer after device_resume.
 */
void device_interrupt(struct device *dev);
void device_resume(struct device *dev);
int device_is_interrupted(const struct device *dev);

/** The device's name and driver version in one line, for people and for EXR attributes. Borrowed. */
const char *device_name(const struct device *dev);

/** The family of traversal kernels that it runs: by its kind, until device_choose_family. */
enum device_family device_family(const struct device *dev);

/** Take one of the families whatever the device is; before its first tracer. */
void device_choose_family(struct device *dev, enum device_family family);

extern const char *const device_family_names[N_DEVICE_FAMILIES + 1]; /* ended by NULL */

/**
 * Keep what the device's compiler makes of the kernels in a folder, for other runs; processes may share it. Before its first
 * kernel runs. A driver that is known to keep it itself (PoCL) is left to it unless `always`. Does nothing on the reference device.
 * @param folder  copied
 */
void device_keep_programs(struct device *dev, const char *folder, int always);

/** How many programs came from there, for this device and all that were shared from it. */
unsigned device_programs_found(const struct device *dev);

/**
 * Make a buffer at least so large; contents are lost where it grows. *buffer NULL: a new one. 0 bytes count as 16.
 * Drivers hand out memory that is not there and fail when it is used: what this device and all shared from it hold together is
 * counted here.
 * @return 0 or ERR_SYSTEM (reported with the size, and what the device has)
 */
int device_reserve(struct device *dev, struct device_buffer **buffer, size_t bytes);
void device_release(struct device *dev, struct device_buffer **buffer);

/** Copy into or out of a buffer; both return when the bytes have been copied and all earlier kernels are done. */
int device_write(struct device *dev, struct device_buffer *buffer, size_t offset, const void *data, size_t bytes);
int device_read(struct device *dev, const struct device_buffer *buffer, size_t offset, void *data, size_t bytes);

/**
 * Queue a kernel; kernels of a device run one after the other, in the order queued.
 * @param n_items  work items; 0: nothing is queued
 * @return 0 or ERR_SYSTEM (reported: kernel, OpenCL's error by name)
 */
int device_run(struct device *dev, enum device_kernel kernel, size_t n_items, const struct device_arg *args,
               size_t n_args);

/** Wait until everything queued is done. @return 0 or ERR_SYSTEM (reported) */
int device_finish(struct device *dev);

/* What a device did, kernel by kernel, and what copying took. */
struct device_spent {
	double wall_s, cpu_s; /* cpu_s: of all threads of this process; says nothing where the device is no CPU */
	uint64_t count, amount; /* launches and work items, or copies and bytes */
};

struct device_profile {
	struct device_spent kernels[N_DEVICE_KERNELS], writes, reads;
};

/**
 * Add what is done from now on to a profile; each kernel is waited for, so that everything takes longer.
 * @param profile  kept and written until the next call; NULL: no longer
 */
void device_set_profile(struct device *dev, struct device_profile *profile);
const char *device_kernel_name(enum device_kernel kernel);

#endif
