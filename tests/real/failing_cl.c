/*
 * An OpenCL device that fails, or has less than it seems: preloaded before the ICD loader, it
 *   FAIL_AFTER=N   refuses to run kernels from the N-th launch on, as a GPU does that fell off the bus
 *   FAIL_ONLY=1    the same on the first device used alone: others go on
 *   SLOW_BUILD=1   compiles for a second and a half longer
 *   AS_TYPE=gpu    says that it is a GPU (accelerator: one of these)
 *   AS_MEMORY=N    says that it has so many bytes of memory
 *   AS_BUFFER=N    says that no buffer may be larger
 * Everything else goes to the real device.
 */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static atomic_long launches;
static _Atomic(cl_device_id) first;

/* Whether launches on a queue's device may fail. */
static int is_chosen(cl_command_queue queue)
{
	cl_device_id device = NULL, none = NULL;

	if (!getenv("FAIL_ONLY"))
		return 1;
	clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof(device), &device, NULL);
	return atomic_compare_exchange_strong(&first, &none, device) || none == device;
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t *offset,
                              const size_t *global, const size_t *local, cl_uint n, const cl_event *wait, cl_event *event)
{
	const char *after = getenv("FAIL_AFTER");

	if (after && is_chosen(queue) && atomic_fetch_add(&launches, 1) >= atol(after))
		return CL_OUT_OF_RESOURCES;
	return REAL(clEnqueueNDRangeKernel)(queue, kernel, dimensions, offset, global, local, n, wait, event);
}

cl_int clBuildProgram(cl_program program, cl_uint n, const cl_device_id *devices, const char *options,
                      void(CL_CALLBACK *notify)(cl_program, void *), void *user)
{
	if (getenv("SLOW_BUILD"))
		nanosleep(&(struct timespec){ 1, 500000000 }, NULL);
	return REAL(clBuildProgram)(program, n, devices, options, notify, user);
}

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info what, size_t size, void *value, size_t *needed)
{
	const cl_int code = REAL(clGetDeviceInfo)(device, what, size, value, needed);
	const char *type = getenv("AS_TYPE"), *memory = getenv("AS_MEMORY"), *buffer = getenv("AS_BUFFER");
	cl_device_type as = type && strcmp(type, "gpu") == 0 ? CL_DEVICE_TYPE_GPU : CL_DEVICE_TYPE_ACCELERATOR;
	cl_ulong bytes;

	if (code != CL_SUCCESS || !value)
		return code;
	if (what == CL_DEVICE_TYPE && type)
		memcpy(value, &as, sizeof(as));
	bytes = memory && what == CL_DEVICE_GLOBAL_MEM_SIZE ? strtoull(memory, NULL, 10) :
	        buffer && what == CL_DEVICE_MAX_MEM_ALLOC_SIZE ? strtoull(buffer, NULL, 10) : 0;
	if (bytes)
		memcpy(value, &bytes, sizeof(bytes));
	return code;
}
