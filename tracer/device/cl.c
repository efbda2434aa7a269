#include "tracer/device/cl.h"

#include <pthread.h>
#include <stdio.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "tracer/device/cl_error.h"
#include "tracer/device/cl_launch.h"
#include "tracer/device/cl_list.h"
#include "tracer/device/cl_program.h"
#include "tracer/device/fault.h"
#include "kernels/embed.h"

/*
 * Work items in a group on a CPU. The driver runs a group's items in a loop. Small groups cost a call each; large ones
 * leave cores idle at the end of a launch.
 */
#define GROUP_CPU 8
#define GROUP_GPU 64

/* Small writes to a CPU device are staged instead of waiting for them: each wait puts one thread to sleep and wakes
 * another. */
#define STAGE_BYTES ((size_t)1 << 20)
#define STAGE_MOST ((size_t)1 << 16) /* most bytes of one staged write */

/* State common to all devices shared from one device. */
struct cl_common {
	pthread_mutex_t lock;
	unsigned refs;
	cl_device_id root, id; /* id: root, or a sub-device of it */
	cl_context context;
	pthread_mutex_t programs_lock; /* guards all programs; held while one is built */
	cl_program *programs; /* [n_kernel_files], NULL: not built yet */
	pthread_t builder;
	size_t built_early; /* the file whose program the builder thread builds; n_kernel_files: no builder */
	int early_err;      /* result of that build, until its first use */
	struct fault_place *early; /* records when the builder is in the driver */
	struct cl_keeping keeping;
	struct cl_common *left; /* next in the list of those left by closed devices (cl_leave_programs) */
	const struct hook *hook; /* or NULL */
	int said; /* cl_report */
	uint64_t memory_bytes, buffer_bytes, used_bytes; /* total of the device; most of one buffer; all buffers now */
};

struct cl_device {
	struct cl_common *common;
	struct fault_place *place; /* or NULL */
	cl_command_queue queue;
	cl_kernel kernels[N_KERNELS]; /* not shared: a kernel object includes its arguments */
	struct cl_pace paces[N_KERNELS]; /* used unless the device is a CPU */
	unsigned char widened[N_KERNELS]; /* used if the driver is PoCL: cl_launch_wide */
	int cpu, pocl;
	enum device_family family;
	char *staged;    /* [STAGE_BYTES] for a CPU: small writes in progress; NULL: none yet */
	size_t n_staged; /* staged bytes that may not have been written yet */
	char lack[160]; /* description of the last ERR_MEMORY */
};

struct cl_buffer {
	cl_mem mem;
	size_t bytes;
};

/* Kept until the process ends. */
static struct cl_common *all_left;
static pthread_mutex_t left_lock = PTHREAD_MUTEX_INITIALIZER;

/*
 * Replace the device by a sub-device with `threads` units, so that a run uses no more cores than it was given. CPU
 * devices of PoCL 7 do not support sub-devices; a message says so.
 */
static int limit_threads(struct cl_common *dev, int cpu, unsigned threads)
{
	const cl_device_partition_property counts[] = { CL_DEVICE_PARTITION_BY_COUNTS, threads,
		                                        CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0 };
	static atomic_int said;
	cl_uint units = 0, parts = 0;
	cl_int code;

	clGetDeviceInfo(dev->root, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof(units), &units, NULL);
	if (!cpu || threads == 0 || threads >= units)
		return 0;
	clGetDeviceInfo(dev->root, CL_DEVICE_PARTITION_MAX_SUB_DEVICES, sizeof(parts), &parts, NULL);
	if (parts < 1) {
		if (!said++)
			err_warn(NULL, "this device cannot be limited to %u of its %u threads, and uses all of them", threads, units);
		return 0;
	}
	code = clCreateSubDevices(dev->root, counts, 1, &dev->id, NULL);
	if (code == CL_SUCCESS)
		return 0;
	dev->id = dev->root;
	return cl_report(&dev->said, code, "this device cannot be limited to fewer threads");
}

static void join_builder(struct cl_common *c)
{
	if (c->built_early < n_kernel_files)
		pthread_join(c->builder, NULL);
	fault_close(&c->early);
	c->built_early = n_kernel_files;
}

static void release_common(struct cl_common *c)
{
	unsigned refs;

	if (!c)
		return;
	pthread_mutex_lock(&c->lock);
	refs = --c->refs;
	pthread_mutex_unlock(&c->lock);
	if (refs)
		return;
	join_builder(c);
	for (size_t i = 0; c->programs && i < n_kernel_files; i++)
		if (c->programs[i])
			clReleaseProgram(c->programs[i]);
	free(c->programs);
	if (c->context)
		clReleaseContext(c->context);
	if (c->id != c->root)
		clReleaseDevice(c->id);
	pthread_mutex_destroy(&c->programs_lock);
	pthread_mutex_destroy(&c->lock);
	free(c);
}

static struct cl_common *create_common(void)
{
	struct cl_common *c = calloc(1, sizeof(*c));

	if (c)
		c->programs = calloc(n_kernel_files + 1, sizeof(*c->programs));
	if (!c || !c->programs) {
		free(c);
		err_report(ERR_SYSTEM, NULL, "out of memory");
		return NULL;
	}
	pthread_mutex_init(&c->lock, NULL);
	pthread_mutex_init(&c->programs_lock, NULL);
	c->built_early = n_kernel_files;
	c->refs = 1;
	return c;
}

static int open_queue(struct cl_device *dev)
{
	cl_int code;

	dev->queue = clCreateCommandQueue(dev->common->context, dev->common->id,
	                                  dev->cpu ? 0 : CL_QUEUE_PROFILING_ENABLE, &code);
	return dev->queue ? 0 : cl_report(&dev->common->said, code, "clCreateCommandQueue");
}

int cl_open(size_t number, unsigned threads, struct fault_place *place, struct cl_device **out)
{
	cl_device_id ids[CL_LIST_MOST];
	struct cl_device *dev = NULL;
	struct cl_common *common;
	cl_int code;
	size_t n;
	int err = cl_list_find(ids, &n);

	if (err)
		return err;
	if (number >= n)
		return err_report(ERR_SYSTEM, "OpenCL", "device %zu is gone", number);
	dev = calloc(1, sizeof(*dev));
	if (!dev)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	dev->place = place;
	common = dev->common = create_common();
	if (!common) {
		err = ERR_SYSTEM;
		goto fail;
	}
	common->root = common->id = ids[number];
	dev->cpu = cl_list_type(common->root) == DEVICE_CPU;
	dev->pocl = dev->cpu && cl_program_is_pocl(common->root);
	common->memory_bytes = cl_list_bytes(common->root, CL_DEVICE_GLOBAL_MEM_SIZE);
	common->buffer_bytes = cl_list_bytes(common->root, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
	err = limit_threads(common, dev->cpu, threads);
	if (err)
		goto fail;
	common->context = clCreateContext(NULL, 1, &common->id, NULL, NULL, &code);
	if (!common->context) {
		err = cl_report(&common->said, code, "clCreateContext");
		goto fail;
	}
	err = open_queue(dev);
	if (err)
		goto fail;
	*out = dev;
	return 0;
fail:
	cl_close(&dev);
	return err;
}

int cl_share(struct cl_device *dev, struct fault_place *place, struct cl_device **out)
{
	struct cl_device *other = calloc(1, sizeof(*other));
	int err;

	if (!other)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	pthread_mutex_lock(&dev->common->lock);
	dev->common->refs++;
	pthread_mutex_unlock(&dev->common->lock);
	other->common = dev->common;
	other->place = place;
	other->cpu = dev->cpu;
	other->pocl = dev->pocl;
	other->family = dev->family;
	err = open_queue(other);
	if (err)
		cl_close(&other);
	*out = other;
	return err;
}

void cl_choose_family(struct cl_device *dev, enum device_family family)
{
	dev->family = family;
}

void cl_close(struct cl_device **dev)
{
	struct cl_device *d = *dev;

	*dev = NULL;
	if (!d)
		return;
	for (size_t i = 0; i < N_KERNELS; i++) {
		cl_pace_free(&d->paces[i]);
		if (d->kernels[i])
			clReleaseKernel(d->kernels[i]);
	}
	if (d->queue && d->n_staged)
		clFinish(d->queue);
	if (d->queue)
		clReleaseCommandQueue(d->queue);
	free(d->staged);
	release_common(d->common);
	free(d);
}

int cl_report_lack(struct cl_device *dev)
{
	return __atomic_exchange_n(&dev->common->said, 1, __ATOMIC_RELAXED) ?
	               ERR_SYSTEM :
	               err_report(ERR_SYSTEM, "OpenCL", "%s", dev->lack);
}

/* Handle an OpenCL error. @return ERR_MEMORY if a resource ran out; otherwise ERR_SYSTEM (reported) */
static int lack_or_report(struct cl_device *dev, cl_int code, const char *what)
{
	if (code != CL_MEM_OBJECT_ALLOCATION_FAILURE && code != CL_OUT_OF_RESOURCES && code != CL_INVALID_BUFFER_SIZE)
		return cl_report(&dev->common->said, code, what);
	snprintf(dev->lack, sizeof(dev->lack), "%s: %s (%d)", what, cl_error_name(code), code);
	return ERR_MEMORY;
}

/* Count the memory of a new buffer. @return 0, or ERR_MEMORY if it does not fit */
static int take_memory(struct cl_device *dev, size_t bytes)
{
	struct cl_common *c = dev->common;
	uint64_t used;

	if (bytes > c->buffer_bytes) {
		snprintf(dev->lack, sizeof(dev->lack),
		         "a buffer of %llu MiB is needed, and this device makes none of more than %llu: choose another "
		         "--device",
		         (unsigned long long)(bytes + 0xfffff) >> 20, (unsigned long long)c->buffer_bytes >> 20);
		return ERR_MEMORY;
	}
	pthread_mutex_lock(&c->lock);
	used = c->used_bytes + bytes;
	if (used <= c->memory_bytes)
		c->used_bytes = used;
	pthread_mutex_unlock(&c->lock);
	if (used <= c->memory_bytes)
		return 0;
	snprintf(dev->lack, sizeof(dev->lack),
	         "%llu MiB are needed on this device, which has %llu: fewer --jobs, or another --device",
	         (unsigned long long)(used + 0xfffff) >> 20, (unsigned long long)c->memory_bytes >> 20);
	return ERR_MEMORY;
}

static void give_memory(struct cl_common *c, size_t bytes)
{
	pthread_mutex_lock(&c->lock);
	c->used_bytes -= bytes;
	pthread_mutex_unlock(&c->lock);
}

int cl_reserve(struct cl_device *dev, struct cl_buffer **buffer, size_t bytes)
{
	struct cl_buffer *b = *buffer;
	char what[64];
	cl_int code;

	if (bytes == 0)
		bytes = 16;
	if (b && b->bytes >= bytes)
		return 0;
	if (!b)
		b = *buffer = calloc(1, sizeof(*b));
	if (!b)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (b->mem)
		clReleaseMemObject(b->mem);
	b->mem = NULL;
	give_memory(dev->common, b->bytes);
	b->bytes = 0;
	if (take_memory(dev, bytes))
		return ERR_MEMORY;
	b->mem = clCreateBuffer(dev->common->context, CL_MEM_READ_WRITE, bytes, NULL, &code);
	if (!b->mem) {
		give_memory(dev->common, bytes);
		snprintf(what, sizeof(what), "a buffer of %zu bytes", bytes);
		return lack_or_report(dev, code, what);
	}
	b->bytes = bytes;
	return 0;
}

void cl_release(struct cl_device *dev, struct cl_buffer **buffer)
{
	if (*buffer && (*buffer)->mem)
		clReleaseMemObject((*buffer)->mem);
	if (*buffer)
		give_memory(dev->common, (*buffer)->bytes);
	free(*buffer);
	*buffer = NULL;
}

/* Record that all queued commands are done. */
static int note_done(struct cl_device *dev, cl_int code, const char *what)
{
	if (code != CL_SUCCESS)
		return cl_report(&dev->common->said, code, what);
	dev->n_staged = 0;
	fault_done(dev->place);
	return 0;
}

/* Copy data for a write; the copy stays until all queued commands are done. NULL: too much data, or not a CPU */
static const void *stage(struct cl_device *dev, const void *data, size_t bytes)
{
	char *copy;

	if (!dev->cpu || bytes > STAGE_MOST || bytes > STAGE_BYTES - dev->n_staged)
		return NULL;
	if (!dev->staged)
		dev->staged = malloc(STAGE_BYTES);
	if (!dev->staged)
		return NULL;
	copy = memcpy(dev->staged + dev->n_staged, data, bytes);
	dev->n_staged += bytes;
	return copy;
}

int cl_write(struct cl_device *dev, struct cl_buffer *buffer, size_t offset, const void *data, size_t bytes)
{
	const void *later;
	cl_int code;

	if (bytes == 0)
		return 0;
	later = stage(dev, data, bytes);
	code = clEnqueueWriteBuffer(dev->queue, buffer->mem, later ? CL_FALSE : CL_TRUE, offset, bytes,
	                            later ? later : data, 0, NULL, NULL);
	if (code == CL_MEM_OBJECT_ALLOCATION_FAILURE)
		return lack_or_report(dev, code, "writing a buffer");
	if (code == CL_SUCCESS && later)
		return 0;
	return note_done(dev, code, "writing a buffer");
}

int cl_read(struct cl_device *dev, const struct cl_buffer *buffer, size_t offset, void *data, size_t bytes)
{
	if (bytes == 0)
		return 0;
	return note_done(dev, clEnqueueReadBuffer(dev->queue, buffer->mem, CL_TRUE, offset, bytes, data, 0, NULL, NULL),
	                 "reading a buffer");
}

int cl_map(struct cl_device *dev, const struct cl_buffer *buffer, size_t bytes, int wait, const void **out)
{
	cl_int code;

	*out = NULL;
	if (bytes == 0)
		return 0;
	*out = clEnqueueMapBuffer(dev->queue, buffer->mem, wait ? CL_TRUE : CL_FALSE, CL_MAP_READ, 0, bytes, 0, NULL,
	                          NULL, &code);
	if (*out && !wait)
		return 0;
	return note_done(dev, code, "mapping a buffer");
}

int cl_unmap(struct cl_device *dev, const struct cl_buffer *buffer, const void *mapped)
{
	const cl_int code = mapped ? clEnqueueUnmapMemObject(dev->queue, buffer->mem, (void *)mapped, 0, NULL, NULL) :
	                             CL_SUCCESS;

	return code == CL_SUCCESS ? 0 : cl_report(&dev->common->said, code, "unmapping a buffer");
}

int cl_finish(struct cl_device *dev)
{
	return note_done(dev, clFinish(dev->queue), "clFinish");
}

/* Build the program of a file. If the early build failed and was reported, the first caller fails with its error; later
 * callers build it again. */
static int build_program(struct cl_common *c, size_t file, struct fault_place *place)
{
	if (file == c->built_early && c->early_err) {
		const int err = c->early_err;

		c->early_err = 0;
		return err;
	}
	return c->programs[file] ? 0 :
	                           cl_program_make(c->context, c->id, file, c->hook, &c->keeping, place, &c->said,
	                                           &c->programs[file]);
}

void cl_take_hook(struct cl_device *dev, const struct hook *hook)
{
	pthread_mutex_lock(&dev->common->programs_lock);
	dev->common->hook = hook;
	pthread_mutex_unlock(&dev->common->programs_lock);
}

void cl_keep_programs(struct cl_device *dev, const char *folder, int always)
{
	pthread_mutex_lock(&dev->common->programs_lock);
	cl_program_keep(dev->common->root, folder, always, &dev->common->keeping);
	pthread_mutex_unlock(&dev->common->programs_lock);
}

void cl_tell_compiling(struct cl_device *dev)
{
	pthread_mutex_lock(&dev->common->programs_lock);
	dev->common->keeping.tells = 1;
	pthread_mutex_unlock(&dev->common->programs_lock);
}

static void *build_early(void *arg)
{
	struct cl_common *c = arg;

	memory_widen_heap();
	pthread_mutex_lock(&c->programs_lock);
	fault_enter(c->early);
	c->early_err = fault_leave(c->early, build_program(c, c->built_early, c->early));
	pthread_mutex_unlock(&c->programs_lock);
	return NULL;
}

void cl_build_early(struct cl_device *dev, struct fault_place *place)
{
	struct cl_common *c = dev->common;

	if (c->built_early == n_kernel_files)
		c->built_early = cl_program_gathered(c->root, &c->keeping, dev->family);
	if (c->built_early == n_kernel_files || c->early) {
		fault_close(&place);
		return;
	}
	c->early = place;
	if (pthread_create(&c->builder, NULL, build_early, c)) {
		c->built_early = n_kernel_files;
		fault_close(&c->early);
	}
}

void cl_leave_programs(struct cl_device *dev)
{
	struct cl_common *c = dev->common;

	join_builder(c);
	pthread_mutex_lock(&c->lock);
	c->refs++;
	pthread_mutex_unlock(&c->lock);
	pthread_mutex_lock(&left_lock);
	c->left = all_left;
	all_left = c;
	pthread_mutex_unlock(&left_lock);
}

unsigned cl_programs_found(struct cl_device *dev)
{
	unsigned n;

	pthread_mutex_lock(&dev->common->programs_lock);
	n = dev->common->keeping.found;
	pthread_mutex_unlock(&dev->common->programs_lock);
	return n;
}

static int make_kernel(struct cl_device *dev, enum kernel kernel)
{
	const char *name = kernel_entries[kernel].name;
	const size_t file = cl_program_of(dev->common->root, &dev->common->keeping, dev->family, name);
	cl_int code;
	int err;

	if (file == n_kernel_files)
		return err_report(ERR_SYSTEM, "OpenCL", "there is no kernel %s in this build", name);
	pthread_mutex_lock(&dev->common->programs_lock);
	err = build_program(dev->common, file, dev->place);
	pthread_mutex_unlock(&dev->common->programs_lock);
	if (err)
		return err;
	fault_build(dev->place, name);
	dev->kernels[kernel] = clCreateKernel(dev->common->programs[file], name, &code);
	fault_build(dev->place, NULL);
	if (dev->kernels[kernel])
		return 0;
	fault_refuse(dev->place, code, 1, name);
	return cl_report(&dev->common->said, code, name);
}

int cl_run(struct cl_device *dev, enum kernel kernel, size_t n_items, const struct cl_arg *args, size_t n_args)
{
	char what[96];
	cl_int code = CL_SUCCESS;
	int err;

	if (n_items == 0)
		return 0;
	if (!dev->kernels[kernel]) {
		err = make_kernel(dev, kernel);
		if (err)
			return err;
	}
	for (size_t i = 0; i < n_args && code == CL_SUCCESS; i++) {
		if (args[i].buffer)
			code = clSetKernelArg(dev->kernels[kernel], (cl_uint)i, sizeof(cl_mem), &args[i].buffer->mem);
		else
			code = clSetKernelArg(dev->kernels[kernel], (cl_uint)i, args[i].bytes, args[i].value);
		if (code != CL_SUCCESS) {
			snprintf(what, sizeof(what), "kernel %s, argument %zu", kernel_entries[kernel].name, i);
			return cl_report(&dev->common->said, code, what);
		}
	}
	fault_launch(dev->place, kernel);
	code = dev->pocl ? cl_launch_wide(dev->queue, dev->kernels[kernel], n_items, GROUP_CPU, &dev->widened[kernel]) :
	                   cl_launch(dev->queue, dev->kernels[kernel], n_items, dev->cpu ? GROUP_CPU : GROUP_GPU,
	                             dev->cpu ? NULL : &dev->paces[kernel]);
	if (code != CL_SUCCESS) {
		if (!cl_error_exists(code))
			fault_refuse(dev->place, code, 0, kernel_entries[kernel].name);
		snprintf(what, sizeof(what), "kernel %s", kernel_entries[kernel].name);
		return lack_or_report(dev, code, what);
	}
	return 0;
}
